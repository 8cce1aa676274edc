// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>

namespace corvo::orb {

/// Divides `total` in proportion to `weights`, with no share above its capacity. The excess of a
/// capped share is divided among the others in proportion to their weights; the shares sum to
/// min(total, sum of capacities). Rounding is by largest remainder, ties to the lower index.
/// Weights are positive where capacities are. The three spans have the same size, at most 64.
void Apportion(int total, std::span<const std::int64_t> weights, std::span<const int> capacities,
               std::span<int> shares);

}  // namespace corvo::orb
