// SPDX-License-Identifier: MIT
#include "orb/kernels/distances_among.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

#include <hwy/cache_control.h>

#include "orb/hamming.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "orb/kernels/distances_among.cpp"
#include <hwy/foreach_target.h>  // Compiles this file once for every instruction set.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace corvo::orb::kernels::HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128
using scalar::FindDistancesAmong;
#else

using Words = std::array<std::uint64_t, 4>;

constexpr int kAhead = 24;  ///< Candidates that are on their way from memory.

HWY_INLINE Words WordsOf(const Descriptor& descriptor) {
  Words words;
  std::memcpy(words.data(), descriptor.bytes.data(), sizeof(words));
  return words;
}

/// With these instruction sets, std::popcount is an instruction.
HWY_INLINE std::uint16_t CountDifferences(const Words& a, const Words& b) {
  int count = 0;
  for (int i = 0; i < 4; ++i) count += std::popcount(a[i] ^ b[i]);
  return static_cast<std::uint16_t>(count);
}

void FindDistancesAmong(const Descriptor& query, const Descriptor* train,
                        const std::uint32_t* candidates, int count, std::uint16_t* distances) {
  const Words words = WordsOf(query);
  for (int i = 0; i < std::min(kAhead, count); ++i) hwy::Prefetch(train + candidates[i]);
  for (int i = 0; i < count; ++i) {
    if (i + kAhead < count) hwy::Prefetch(train + candidates[i + kAhead]);
    distances[i] = CountDifferences(words, WordsOf(train[candidates[i]]));
  }
}

#endif
}  // namespace corvo::orb::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace corvo::orb::kernels {

HWY_EXPORT(FindDistancesAmong);

void FindDistancesAmong(const Descriptor& query, const Descriptor* train,
                        const std::uint32_t* candidates, int count, std::uint16_t* distances) {
  HWY_DYNAMIC_DISPATCH(FindDistancesAmong)(query, train, candidates, count, distances);
}

namespace scalar {

void FindDistancesAmong(const Descriptor& query, const Descriptor* train,
                        const std::uint32_t* candidates, int count, std::uint16_t* distances) {
  for (int i = 0; i < count; ++i) {
    distances[i] = static_cast<std::uint16_t>(HammingDistance(query, train[candidates[i]]));
  }
}

}  // namespace scalar
}  // namespace corvo::orb::kernels
#endif
