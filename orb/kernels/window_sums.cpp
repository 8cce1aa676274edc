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
using scalar::SlideColumns;
using scalar::SumColumns;
using scalar::SumWindows;
#else
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::ScalableTag<std::uint16_t>;
using Lanes = hn::Vec<Tag>;

HWY_INLINE Lanes LoadPixels(const std::uint8_t* pixels) {
  return hn::PromoteTo(Tag(), hn::LoadU(hn::Rebind<std::uint8_t, Tag>(), pixels));
}

void SumColumns(const std::uint8_t* HWY_RESTRICT row, std::ptrdiff_t stride, int width,
                std::uint16_t* HWY_RESTRICT columns) {
  const Tag d;
  const int step = static_cast<int>(hn::Lanes(d));
  if (width < step) return scalar::SumColumns(row, stride, width, columns);
  for (int begin = 0; begin < width; begin += step) {
    const int x = std::min(begin, width - step);
    Lanes sum = LoadPixels(row + x - 2 * stride);
    for (int dy = -1; dy <= 2; ++dy) sum = hn::Add(sum, LoadPixels(row + x + dy * stride));
    hn::StoreU(sum, d, columns + x);
  }
}

void SlideColumns(const std::uint8_t* HWY_RESTRICT row, std::ptrdiff_t stride, int width,
                  std::uint16_t* HWY_RESTRICT columns) {
  const Tag d;
  const int step = static_cast<int>(hn::Lanes(d));
  const int num_whole = width / step * step;
  const std::uint8_t* entering = row + 2 * stride;
  const std::uint8_t* leaving = row - 3 * stride;
  for (int x = 0; x < num_whole; x += step) {
    const Lanes change = hn::Sub(LoadPixels(entering + x), LoadPixels(leaving + x));
    hn::StoreU(hn::Add(hn::LoadU(d, columns + x), change), d, columns + x);
  }
  scalar::SlideColumns(row + num_whole, stride, width - num_whole, columns + num_whole);
}

HWY_INLINE void SumRegisterOfWindows(const std::uint16_t* HWY_RESTRICT columns, int x,
                                     std::uint16_t* HWY_RESTRICT sums) {
  const Tag d;
  Lanes sum = hn::LoadU(d, columns + x - 2);
  for (int dx = -1; dx <= 2; ++dx) sum = hn::Add(sum, hn::LoadU(d, columns + x + dx));
  hn::StoreU(sum, d, sums + x);
}

void SumWindows(const std::uint16_t* HWY_RESTRICT columns, int width,
                std::uint16_t* HWY_RESTRICT sums) {
  const int step = static_cast<int>(hn::Lanes(Tag()));
  if (width - 4 < step) return scalar::SumWindows(columns, width, sums);
  const int last = width - 2 - step;
  for (int x = 2; x < last; x += step) SumRegisterOfWindows(columns, x, sums);
  SumRegisterOfWindows(columns, last, sums);
}

#endif
}  // namespace corvo::orb::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace corvo::orb::kernels {

HWY_EXPORT(SlideColumns);
HWY_EXPORT(SumColumns);
HWY_EXPORT(SumWindows);

void SumColumns(const std::uint8_t* row, std::ptrdiff_t stride, int width, std::uint16_t* columns) {
  HWY_DYNAMIC_DISPATCH(SumColumns)(row, stride, width, columns);
}

void SlideColumns(const std::uint8_t* row, std::ptrdiff_t stride, int width,
                  std::uint16_t* columns) {
  HWY_DYNAMIC_DISPATCH(SlideColumns)(row, stride, width, columns);
}

void SumWindows(const std::uint16_t* columns, int width, std::uint16_t* sums) {
  HWY_DYNAMIC_DISPATCH(SumWindows)(columns, width, sums);
}

namespace scalar {

void SumColumns(const std::uint8_t* row, std::ptrdiff_t stride, int width, std::uint16_t* columns) {
  for (int x = 0; x < width; ++x) {
    int sum = 0;
    for (int dy = -2; dy <= 2; ++dy) sum += row[x + dy * stride];
    columns[x] = static_cast<std::uint16_t>(sum);
  }
}

void SlideColumns(const std::uint8_t* row, std::ptrdiff_t stride, int width,
                  std::uint16_t* columns) {
  for (int x = 0; x < width; ++x) {
    const int change = row[x + 2 * stride] - row[x - 3 * stride];
    columns[x] = static_cast<std::uint16_t>(columns[x] + change);
  }
}

void SumWindows(const std::uint16_t* columns, int width, std::uint16_t* sums) {
  for (int x = 2; x < width - 2; ++x) {
    int sum = 0;
    for (int dx = -2; dx <= 2; ++dx) sum += columns[x + dx];
    sums[x] = static_cast<std::uint16_t>(sum);
  }
}

}  // namespace scalar
}  // namespace corvo::orb::kernels
#endif
