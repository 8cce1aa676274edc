// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace corvo::orb::kernels {

inline constexpr int kCircleRadius = 3;  ///< Of FAST's circle of 16 pixels.
inline constexpr int kMaximaRoom = 4;  ///< Numbers that FindRowMaxima may write beyond its result.

/// FAST-9 scores of `width` neighboring pixels of a row: the largest threshold at which the pixel
/// is a corner where that is `threshold` or more, else 0. `row` points at the first of them; rows
/// are `stride` bytes apart, and there are kCircleRadius pixels on all sides.
void ScoreFastRow(const std::uint8_t* row, std::ptrdiff_t stride, int width, int threshold,
                  std::uint8_t* scores);

/// Columns of the pixels of a row of scores that exceed all 8 neighbors, ascending. The three rows
/// have `width` scores and one more on each side. `columns` is room for width + kMaximaRoom
/// numbers; returns how many count.
int FindRowMaxima(const std::uint8_t* above, const std::uint8_t* here, const std::uint8_t* below,
                  int width, std::uint16_t* columns);

namespace scalar {
void ScoreFastRow(const std::uint8_t* row, std::ptrdiff_t stride, int width, int threshold,
                  std::uint8_t* scores);
int FindRowMaxima(const std::uint8_t* above, const std::uint8_t* here, const std::uint8_t* below,
                  int width, std::uint16_t* columns);
}  // namespace scalar

}  // namespace corvo::orb::kernels
