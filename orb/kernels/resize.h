// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace corvo::orb::kernels {

inline constexpr int kWeightBits = 7;  ///< Weights of interpolation are in units of 2^-7.
inline constexpr int kTapsPerGroup = 8;
inline constexpr int kTapReach = 16;  ///< Source pixels from which the taps of a group read.

/// Linear interpolation at a row of targets, 8 to a group: target 8 g + i takes the source pixels
/// bases[g] + taps[16 g + 2 i] and bases[g] + taps[16 g + 2 i + 1], with the weights of the same
/// indices, which add up to 2^7.
struct TapGroups {
  int count;
  const std::uint8_t* taps;
  const std::uint8_t* weights;
  const std::int32_t* bases;
};

/// Interpolates a row of pixels, in units of 2^-7 gray levels: 8 targets for every group. No tap is
/// kTapReach or more from its base, and the source has kTapReach pixels from every base on; the
/// scalar twin needs neither.
void InterpolateRow(const std::uint8_t* source, const TapGroups& groups, std::int16_t* targets);

/// Rounds (2^7 - weight) a + weight b, halfway up, to whole gray levels. a and b are in units of
/// 2^-7, 0 to 255 * 2^7; `weight` is 0 to 2^7 - 1.
void BlendRows(const std::int16_t* a, const std::int16_t* b, int weight, int width,
               std::uint8_t* blended);

namespace scalar {
void InterpolateRow(const std::uint8_t* source, const TapGroups& groups, std::int16_t* targets);
void BlendRows(const std::int16_t* a, const std::int16_t* b, int weight, int width,
               std::uint8_t* blended);
}  // namespace scalar

}  // namespace corvo::orb::kernels
