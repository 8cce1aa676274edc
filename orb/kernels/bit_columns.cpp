// SPDX-License-Identifier: MIT
#include "orb/kernels/bit_columns.h"

#include <algorithm>
#include <bit>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "orb/kernels/bit_columns.cpp"
#include <hwy/foreach_target.h>  // Compiles this file once for every instruction set.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace corvo::orb::kernels::HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128
using scalar::CompareRows;
using scalar::CountDifferences;
#else
namespace hn = hwy::HWY_NAMESPACE;

void CompareRows(const std::uint16_t* HWY_RESTRICT p, const std::uint16_t* HWY_RESTRICT q,
                 int count, std::uint64_t* HWY_RESTRICT words) {
  const hn::CappedTag<std::uint16_t, 32> d;
  const int step = static_cast<int>(hn::Lanes(d));  // A multiple of 8 that divides 64.
  const int num_whole = count / 64 * 64;
  auto* bytes = reinterpret_cast<std::uint8_t*>(words);
  for (int i = 0; i < num_whole; i += step) {
    hn::StoreMaskBits(d, hn::Lt(hn::LoadU(d, p + i), hn::LoadU(d, q + i)), bytes + i / 8);
  }
  scalar::CompareRows(p + num_whole, q + num_whole, count - num_whole, words + num_whole / 64);
}

int CountDifferences(const std::uint64_t* HWY_RESTRICT a, const std::uint64_t* HWY_RESTRICT b,
                     int num_words) {
  const hn::CappedTag<std::uint64_t, 8> d64;
  const hn::Repartition<std::uint8_t, decltype(d64)> d8;
  const int step = static_cast<int>(hn::Lanes(d64));
  const int num_whole = num_words / step * step;
  auto sum = hn::Zero(d64);
  for (int i = 0; i < num_whole; i += step) {
    const auto differing = hn::Xor(hn::LoadU(d64, a + i), hn::LoadU(d64, b + i));
    sum = hn::Add(sum, hn::SumsOf8(hn::PopulationCount(hn::BitCast(d8, differing))));
  }
  return static_cast<int>(hn::GetLane(hn::SumOfLanes(d64, sum))) +
         scalar::CountDifferences(a + num_whole, b + num_whole, num_words - num_whole);
}

#endif
}  // namespace corvo::orb::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace corvo::orb::kernels {

HWY_EXPORT(CompareRows);
HWY_EXPORT(CountDifferences);

void CompareRows(const std::uint16_t* p, const std::uint16_t* q, int count, std::uint64_t* words) {
  HWY_DYNAMIC_DISPATCH(CompareRows)(p, q, count, words);
}

int CountDifferences(const std::uint64_t* a, const std::uint64_t* b, int num_words) {
  return HWY_DYNAMIC_DISPATCH(CountDifferences)(a, b, num_words);
}

namespace scalar {

void CompareRows(const std::uint16_t* p, const std::uint16_t* q, int count, std::uint64_t* words) {
  std::fill_n(words, (count + 63) / 64, std::uint64_t{0});
  for (int i = 0; i < count; ++i) words[i / 64] |= std::uint64_t{p[i] < q[i]} << (i % 64);
}

int CountDifferences(const std::uint64_t* a, const std::uint64_t* b, int num_words) {
  int count = 0;
  for (int i = 0; i < num_words; ++i) count += std::popcount(a[i] ^ b[i]);
  return count;
}

}  // namespace scalar
}  // namespace corvo::orb::kernels
#endif
