// SPDX-License-Identifier: MIT
#include "orb/kernels/gradients.h"

#include <iterator>
#include <numeric>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "orb/kernels/gradients.cpp"
#include <hwy/foreach_target.h>  // Compiles this file once for every instruction set.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace corvo::orb::kernels::HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128
using scalar::SumSquaredGradients;
#else
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::ScalableTag<std::uint8_t>;
using Tag16 = hn::RepartitionToWide<hn::RebindToSigned<Tag> >;
using Tag32 = hn::RepartitionToWide<Tag16>;

/// Sums in 32 bits hold a row of 65535 pixels: 8 * 255^2 from each register of them.
struct SquareSums {
  hn::Vec<Tag32> sum;
  hn::Vec<Tag32> rest;  ///< Highway may divide a sum in two.
};

HWY_INLINE void AddSquaredDifferences(hn::Vec<Tag> a, hn::Vec<Tag> b, SquareSums& squares) {
  const Tag16 d16;
  const auto differences = hn::Or(hn::SaturatedSub(a, b), hn::SaturatedSub(b, a));
  const auto pairs = hn::BitCast(hn::RebindToUnsigned<Tag16>(), differences);
  const auto odd = hn::BitCast(d16, hn::ShiftRight<8>(pairs));
  const auto even = hn::And(hn::BitCast(d16, pairs), hn::Set(d16, 0xFF));
  squares.sum = hn::ReorderWidenMulAccumulate(Tag32(), odd, odd, squares.sum, squares.rest);
  squares.sum = hn::ReorderWidenMulAccumulate(Tag32(), even, even, squares.sum, squares.rest);
}

std::int64_t SumSquaredGradients(const std::uint8_t* row, const std::uint8_t* below, int count) {
  const Tag d;
  const Tag32 d32;
  const int step = static_cast<int>(hn::Lanes(d));
  const int num_whole = count / step * step;
  SquareSums squares{hn::Zero(d32), hn::Zero(d32)};
  for (int x = 0; x < num_whole; x += step) {
    const auto here = hn::LoadU(d, row + x);
    AddSquaredDifferences(here, hn::LoadU(d, row + x + 1), squares);
    AddSquaredDifferences(here, hn::LoadU(d, below + x), squares);
  }
  HWY_ALIGN std::int32_t lanes[hn::MaxLanes(Tag32())];
  hn::Store(hn::Add(squares.sum, squares.rest), d32, lanes);
  const std::int64_t whole = std::accumulate(std::begin(lanes), std::end(lanes), std::int64_t{0});
  return whole + scalar::SumSquaredGradients(row + num_whole, below + num_whole, count - num_whole);
}

#endif
}  // namespace corvo::orb::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace corvo::orb::kernels {

HWY_EXPORT(SumSquaredGradients);

std::int64_t SumSquaredGradients(const std::uint8_t* row, const std::uint8_t* below, int count) {
  return HWY_DYNAMIC_DISPATCH(SumSquaredGradients)(row, below, count);
}

namespace scalar {

std::int64_t SumSquaredGradients(const std::uint8_t* row, const std::uint8_t* below, int count) {
  std::int64_t sum = 0;
  for (int x = 0; x < count; ++x) {
    const int right = row[x + 1] - row[x];
    const int down = below[x] - row[x];
    sum += right * right + down * down;
  }
  return sum;
}

}  // namespace scalar
}  // namespace corvo::orb::kernels
#endif
