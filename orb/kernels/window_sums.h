// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace corvo::orb::kernels {

/// Sums over 5 pixels of a column, from two rows above an image row to two below. `row` points at
/// its first pixel; rows are `stride` bytes apart. `columns` is room for `width` numbers.
void SumColumns(const std::uint8_t* row, std::ptrdiff_t stride, int width, std::uint16_t* columns);

/// Turns SumColumns() of the previous row into those of `row`.
void SlideColumns(const std::uint8_t* row, std::ptrdiff_t stride, int width,
                  std::uint16_t* columns);

/// Sums over the 5x5 windows around pixels [2, width - 2) of the row that has these SumColumns().
/// `sums[x]` is written for these x.
void SumWindows(const std::uint16_t* columns, int width, std::uint16_t* sums);

namespace scalar {
void SumColumns(const std::uint8_t* row, std::ptrdiff_t stride, int width, std::uint16_t* columns);
void SlideColumns(const std::uint8_t* row, std::ptrdiff_t stride, int width,
                  std::uint16_t* columns);
void SumWindows(const std::uint16_t* columns, int width, std::uint16_t* sums);
}  // namespace scalar

}  // namespace corvo::orb::kernels
