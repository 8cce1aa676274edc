#pragma once

#include <cstdint>

namespace corvo::orb::kernels {

inline constexpr int kWeightBits = 7;  ///< Weights of interpolation are in units of 2^-7.
inline constexpr int kTapsPerGroup = 8;
inline constexpr int kTapReach = 16;  ///< Source pixels from which the taps of a group read.

/// Linear interpolation at up to 8 neighbouring targets: target + i takes the source pixels
/// base + first[2 i] and base + second[2 i], the second with weight[i], 0 to 2^7 - 1, and the first
/// with the rest to 2^7. The odd bytes are 0x80.
struct alignas(16) TapGroup {
  std::uint8_t first[kTapReach];
  std::uint8_t second[kTapReach];
  std::int16_t weight[kTapsPerGroup];
  std::int32_t base;    ///< The source has kTapReach pixels from it on.
  std::int32_t target;  ///< Groups are in ascending order of it, and later ones write over earlier.
};

/// Interpolates a row of pixels: `targets`, in units of 2^-7 grey levels, has room for
/// kTapsPerGroup from every group's target on.
void InterpolateRow(const std::uint8_t* source, const TapGroup* groups, int num_groups,
                    std::int16_t* targets);

/// Rounds (2^7 - weight) a + weight b, halfway up, to whole grey levels. a and b are in units of
/// 2^-7, 0 to 255 * 2^7; `weight` is 0 to 2^7 - 1.
void BlendRows(const std::int16_t* a, const std::int16_t* b, int weight, int width,
               std::uint8_t* blended);

namespace scalar {
void InterpolateRow(const std::uint8_t* source, const TapGroup* groups, int num_groups,
                    std::int16_t* targets);
void BlendRows(const std::int16_t* a, const std::int16_t* b, int weight, int width,
               std::uint8_t* blended);
}  // namespace scalar

}  // namespace corvo::orb::kernels
