// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace corvo::orb::kernels {

/// Sum of the squared differences between each of `count` neighboring pixels of a row, at most
/// 65535, and the pixels to the right of it and below it. `row` has one pixel more.
std::int64_t SumSquaredGradients(const std::uint8_t* row, const std::uint8_t* below, int count);

namespace scalar {
std::int64_t SumSquaredGradients(const std::uint8_t* row, const std::uint8_t* below, int count);
}  // namespace scalar

}  // namespace corvo::orb::kernels
