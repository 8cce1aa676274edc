// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

namespace corvo::orb {

/// Shares `total` out in proportion to `weights`, no share above its capacity. What one cannot take
/// goes to the others in proportion; the shares sum to min(total, sum of capacities). Rounding is
/// by largest remainder, ties to the lower index. Weights are positive where capacities are. The
/// three spans are of one size, at most 64.
void Apportion(int total, std::span<const std::int64_t> weights, std::span<const int> capacities,
               std::span<int> shares);

}  // namespace corvo::orb
