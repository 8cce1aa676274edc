// SPDX-License-Identifier: MIT
#include "orb/kernels/window_sums.h"

#include <algorithm>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "orb/kernels/window_sums.cpp"
#include <hwy/foreach_target.h>  // Compiles this file once for every instruction set.
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace corvo::orb::kernels::HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128
using scalar::SumWindowRow;
#else
namespace hn = hwy::HWY_NAMESPACE;

void SumWindowRow(const std::uint8_t* HWY_RESTRICT row, std::ptrdiff_t stride, int width,
                  std::uint16_t* HWY_RESTRICT columns, std::uint16_t* HWY_RESTRICT sums) {
  const hn::ScalableTag<std::uint16_t> d16;
  const hn::Rebind<std::uint8_t, decltype(d16)> d8;
  const int step = static_cast<int>(hn::Lanes(d16));
  if (width - 4 < step) return scalar::SumWindowRow(row, stride, width, columns, sums);
  for (int begin = 0; begin < width; begin += step) {
    const int x = std::min(begin, width - step);
    auto sum = hn::PromoteTo(d16, hn::LoadU(d8, row + x - 2 * stride));
    for (int dy = -1; dy <= 2; ++dy) {
      sum = hn::Add(sum, hn::PromoteTo(d16, hn::LoadU(d8, row + x + dy * stride)));
    }
    hn::StoreU(sum, d16, columns + x);
  }
  for (int begin = 2; begin < width - 2; begin += step) {
    const int x = std::min(begin, width - 2 - step);
    auto sum = hn::LoadU(d16, columns + x - 2);
    for (int dx = -1; dx <= 2; ++dx) sum = hn::Add(sum, hn::LoadU(d16, columns + x + dx));
    hn::StoreU(sum, d16, sums + x);
  }
}

#endif
}  // namespace corvo::orb::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace corvo::orb::kernels {

HWY_EXPORT(SumWindowRow);

void SumWindowRow(const std::uint8_t* row, std::ptrdiff_t stride, int width, std::uint16_t* columns,
                  std::uint16_t* sums) {
  HWY_DYNAMIC_DISPATCH(SumWindowRow)(row, stride, width, columns, sums);
}

namespace scalar {

void SumWindowRow(const std::uint8_t* row, std::ptrdiff_t stride, int width, std::uint16_t* columns,
                  std::uint16_t* sums) {
  for (int x = 0; x < width; ++x) {
    int sum = 0;
    for (int dy = -2; dy <= 2; ++dy) sum += row[x + dy * stride];
    columns[x] = static_cast<std::uint16_t>(sum);
  }
  for (int x = 2; x < width - 2; ++x) {
    int sum = 0;
    for (int dx = -2; dx <= 2; ++dx) sum += columns[x + dx];
    sums[x] = static_cast<std::uint16_t>(sum);
  }
}

}  // namespace scalar
}  // namespace corvo::orb::kernels
#endif
