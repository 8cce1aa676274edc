// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace corvo::orb::kernels {

inline constexpr int kFitSide = 8;
inline constexpr int kFitPixels = kFitSide * kFitSide;

/// A window of kFitSide x kFitSide pixels that begins between pixels: `right_share` to the right of
/// `corner` and `lower_share` below it, each in [0, 1). Rows are `stride` bytes apart, and there is
/// one pixel more on the right and below.
struct WindowPlace {
  const std::uint8_t* corner;
  std::ptrdiff_t stride;
  float right_share;
  float lower_share;
};

/// What a window is compared with, row by row.
struct FitTemplate {
  float gray[kFitPixels];
  float by_x[kFitPixels];
  float by_y[kFitPixels];
};

/// Sums over a window's interpolated pixels I - 128.
struct WindowFit {
  float sum = 0;
  float squares = 0;
  float with_gray = 0;  ///< Times the template's gray, ...
  float with_x = 0;     ///< ... by_x ...
  float with_y = 0;     ///< ... and by_y.

  bool operator==(const WindowFit&) const = default;
};

WindowFit FitWindow(const WindowPlace& place, const FitTemplate& wanted);

namespace scalar {
WindowFit FitWindow(const WindowPlace& place, const FitTemplate& wanted);
}  // namespace scalar

}  // namespace corvo::orb::kernels
