// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace corvo::orb::kernels {

inline constexpr int kMomentRadius = 15;  ///< Of the disc dx^2 + dy^2 <= 15^2.

/// Half widths of the disc's rows, from the middle row outwards.
inline constexpr std::array<int, kMomentRadius + 1> kDiscHalfWidths = [] {
  std::array<int, kMomentRadius + 1> widths{};
  for (int dy = 0; dy <= kMomentRadius; ++dy) {
    while ((widths[dy] + 1) * (widths[dy] + 1) + dy * dy <= kMomentRadius * kMomentRadius) {
      ++widths[dy];
    }
  }
  return widths;
}();

/// Sums over the disc around a pixel of dx * I and dy * I.
struct DiscMoments {
  std::int32_t x = 0;
  std::int32_t y = 0;

  bool operator==(const DiscMoments&) const = default;
};

/// `center` points at the pixel; rows are `stride` bytes apart, and there are kMomentRadius + 1
/// pixels on all sides.
DiscMoments SumDiscMoments(const std::uint8_t* center, std::ptrdiff_t stride);

namespace scalar {
DiscMoments SumDiscMoments(const std::uint8_t* center, std::ptrdiff_t stride);
}  // namespace scalar

}  // namespace corvo::orb::kernels
