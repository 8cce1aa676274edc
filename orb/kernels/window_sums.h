// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace corvo::orb::kernels {

/// Sums over the 5x5 windows around pixels [2, width - 2) of an image row. `row` points at its
/// first pixel; rows are `stride` bytes apart, and there are two above and below. `sums[x]` is
/// written for these x; `columns` is room for `width` numbers.
void SumWindowRow(const std::uint8_t* row, std::ptrdiff_t stride, int width, std::uint16_t* columns,
                  std::uint16_t* sums);

namespace scalar {
void SumWindowRow(const std::uint8_t* row, std::ptrdiff_t stride, int width, std::uint16_t* columns,
                  std::uint16_t* sums);
}  // namespace scalar

}  // namespace corvo::orb::kernels
