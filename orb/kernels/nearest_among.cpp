// SPDX-License-Identifier: MIT
#include "orb/kernels/nearest_among.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <limits>

#include "orb/hamming.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "orb/kernels/nearest_among.cpp"
#include <hwy/foreach_target.h>  // Compiles this file once for every instruction set.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace corvo::orb::kernels::HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128
using scalar::FindNearestAmong;
#else

using Words = std::array<std::uint64_t, 4>;

HWY_INLINE Words WordsOf(const Descriptor& descriptor) {
  Words words;
  std::memcpy(words.data(), descriptor.bytes.data(), sizeof(words));
  return words;
}

/// With these instruction sets, std::popcount is an instruction.
HWY_INLINE int CountDifferences(const Words& a, const Words& b) {
  int count = 0;
  for (int i = 0; i < 4; ++i) count += std::popcount(a[i] ^ b[i]);
  return count;
}

/// A candidate's key is its distance, then its index.
Nearest FindNearestAmong(const Descriptor& query, const Descriptor* train,
                         const std::int32_t* candidates, int count) {
  const Words words = WordsOf(query);
  std::uint64_t least = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t second = least;
  for (int i = 0; i < count; ++i) {
    const std::int32_t index = candidates[i];
    const int distance = CountDifferences(words, WordsOf(train[index]));
    const std::uint64_t key = static_cast<std::uint64_t>(distance) << 32 | index;
    second = std::min(second, std::max(least, key));
    least = std::min(least, key);
  }
  Nearest nearest;
  if (count > 0) Update(nearest, static_cast<std::int32_t>(least), static_cast<int>(least >> 32));
  if (count > 1) Update(nearest, static_cast<std::int32_t>(second), static_cast<int>(second >> 32));
  return nearest;
}

#endif
}  // namespace corvo::orb::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace corvo::orb::kernels {

HWY_EXPORT(FindNearestAmong);

Nearest FindNearestAmong(const Descriptor& query, const Descriptor* train,
                         const std::int32_t* candidates, int count) {
  return HWY_DYNAMIC_DISPATCH(FindNearestAmong)(query, train, candidates, count);
}

namespace scalar {
namespace {

/// Takes a candidate into account, whatever its index.
void Insert(Nearest& nearest, int index, int distance) {
  const auto precedes = [&](int other_distance, int other_index) {
    return distance != other_distance ? distance < other_distance : index < other_index;
  };
  if (precedes(nearest.distance, nearest.index)) {
    nearest = {index, distance, nearest.distance, nearest.index};
  } else if (precedes(nearest.second_distance, nearest.second_index)) {
    nearest.second_distance = distance;
    nearest.second_index = index;
  }
}

}  // namespace

Nearest FindNearestAmong(const Descriptor& query, const Descriptor* train,
                         const std::int32_t* candidates, int count) {
  Nearest nearest;
  for (int i = 0; i < count; ++i) {
    Insert(nearest, candidates[i], HammingDistance(query, train[candidates[i]]));
  }
  return nearest;
}

}  // namespace scalar
}  // namespace corvo::orb::kernels
#endif
