// SPDX-License-Identifier: MIT
#include "orb/kernels/window_fit.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "orb/kernels/window_fit.cpp"
#include <hwy/foreach_target.h>  // Compiles this file once for every instruction set.
#include <hwy/highway.h>

#ifndef CORVO_ORB_KERNELS_COLUMN_SUMS
#define CORVO_ORB_KERNELS_COLUMN_SUMS
namespace corvo::orb::kernels {

/// The sums of a WindowFit, column by column: added up in the same order by every instruction set.
struct ColumnSums {
  alignas(64) float sum[kFitSide] = {};
  alignas(64) float squares[kFitSide] = {};
  alignas(64) float with_gray[kFitSide] = {};
  alignas(64) float with_x[kFitSide] = {};
  alignas(64) float with_y[kFitSide] = {};

  WindowFit Total() const {
    WindowFit total;
    for (int column = 0; column < kFitSide; ++column) {
      total.sum += sum[column];
      total.squares += squares[column];
      total.with_gray += with_gray[column];
      total.with_x += with_x[column];
      total.with_y += with_y[column];
    }
    return total;
  }
};

}  // namespace corvo::orb::kernels
#endif

HWY_BEFORE_NAMESPACE();
namespace corvo::orb::kernels::HWY_NAMESPACE {
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128
using scalar::FitWindow;
#else
namespace hn = hwy::HWY_NAMESPACE;

using DF = hn::CappedTag<float, kFitSide>;
using VF = hn::Vec<DF>;

HWY_INLINE VF LoadGray(const std::uint8_t* pixels) {
  const hn::Rebind<std::int32_t, DF> d32;
  const hn::Rebind<std::uint8_t, DF> d8;
  return hn::ConvertTo(DF(), hn::PromoteTo(d32, hn::LoadU(d8, pixels)));
}

/// a + share (b - a), never fused.
HWY_INLINE VF Between(VF a, VF b, VF share) { return hn::Add(a, hn::Mul(share, hn::Sub(b, a))); }

HWY_INLINE VF RowBetween(const std::uint8_t* pixels, VF right_share) {
  return Between(LoadGray(pixels), LoadGray(pixels + 1), right_share);
}

HWY_INLINE void SumColumns(const WindowPlace& place, const FitTemplate& wanted, int column,
                           ColumnSums& sums) {
  const DF d;
  const VF right_share = hn::Set(d, place.right_share);
  const VF lower_share = hn::Set(d, place.lower_share);
  const VF middle = hn::Set(d, 128);
  VF sum = hn::Zero(d), squares = sum, with_gray = sum, with_x = sum, with_y = sum;
  const std::uint8_t* pixels = place.corner + column;
  VF upper = RowBetween(pixels, right_share);
  for (int i = column; i < kFitPixels; i += kFitSide) {
    pixels += place.stride;
    const VF lower = RowBetween(pixels, right_share);
    const VF gray = hn::Sub(Between(upper, lower, lower_share), middle);
    sum = hn::Add(sum, gray);
    squares = hn::Add(squares, hn::Mul(gray, gray));
    with_gray = hn::Add(with_gray, hn::Mul(gray, hn::LoadU(d, wanted.gray + i)));
    with_x = hn::Add(with_x, hn::Mul(gray, hn::LoadU(d, wanted.by_x + i)));
    with_y = hn::Add(with_y, hn::Mul(gray, hn::LoadU(d, wanted.by_y + i)));
    upper = lower;
  }
  hn::Store(sum, d, sums.sum + column);
  hn::Store(squares, d, sums.squares + column);
  hn::Store(with_gray, d, sums.with_gray + column);
  hn::Store(with_x, d, sums.with_x + column);
  hn::Store(with_y, d, sums.with_y + column);
}

WindowFit FitWindow(const WindowPlace& place, const FitTemplate& wanted) {
  ColumnSums sums;
  const int lanes = static_cast<int>(hn::Lanes(DF()));
  for (int column = 0; column < kFitSide; column += lanes) {
    SumColumns(place, wanted, column, sums);
  }
  return sums.Total();
}

#endif
}  // namespace corvo::orb::kernels::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace corvo::orb::kernels {

HWY_EXPORT(FitWindow);

WindowFit FitWindow(const WindowPlace& place, const FitTemplate& wanted) {
  return HWY_DYNAMIC_DISPATCH(FitWindow)(place, wanted);
}

namespace scalar {
namespace {

float GrayAt(const WindowPlace& place, int column, int row) {
  const std::uint8_t* pixels = place.corner + row * place.stride + column;
  const float left = pixels[0], right = pixels[1];
  return left + place.right_share * (right - left);
}

}  // namespace

WindowFit FitWindow(const WindowPlace& place, const FitTemplate& wanted) {
  ColumnSums sums;
  for (int i = 0; i < kFitPixels; ++i) {
    const int column = i % kFitSide, row = i / kFitSide;
    const float upper = GrayAt(place, column, row), lower = GrayAt(place, column, row + 1);
    const float gray = upper + place.lower_share * (lower - upper) - 128;
    sums.sum[column] += gray;
    sums.squares[column] += gray * gray;
    sums.with_gray[column] += gray * wanted.gray[i];
    sums.with_x[column] += gray * wanted.by_x[i];
    sums.with_y[column] += gray * wanted.by_y[i];
  }
  return sums.Total();
}

}  // namespace scalar
}  // namespace corvo::orb::kernels
#endif
