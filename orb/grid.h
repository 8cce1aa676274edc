#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <opencv2/core/types.hpp>

namespace corvo::orb {

/// A corner of one level as the selection sees it.
struct RankedCorner {
  int x = 0;
  int y = 0;
  bool strong = false;        ///< Passes the higher threshold: goes before all that do not.
  std::int64_t strength = 0;  ///< FAST score or Harris response.
};

/// Shares `total` out in proportion to `weights`, no share above its capacity. What one cannot take
/// goes to the others in proportion; the shares sum to min(total, sum of capacities). Rounding is
/// by largest remainder, ties to the lower index. Weights are positive where capacities are.
std::vector<int> Apportion(int total, std::span<const std::int64_t> weights,
                           std::span<const int> capacities);

/// Picks min(quota, corners.size()) corners spread over equal cells of about `cell_size` px that
/// tile `area`; returns ascending indices. `corners` are in row-major order and lie in `area`.
/// Every cell gives its k strongest (or all it has) for the largest k that fits the quota; what
/// remains goes to the strongest of those next in their cells. Ties go to the lower index.
std::vector<int> SelectInGrid(std::span<const RankedCorner> corners, const cv::Rect& area,
                              int cell_size, int quota);

/// Picks the min(quota, corners.size()) strongest; returns ascending indices.
std::vector<int> SelectStrongest(std::span<const RankedCorner> corners, int quota);

}  // namespace corvo::orb
