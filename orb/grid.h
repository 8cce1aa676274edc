#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <opencv2/core/types.hpp>

#include "orb/fast.h"

namespace corvo::orb {

/// Shares `total` out in proportion to `weights`, no share above its capacity. What one cannot take
/// goes to the others in proportion; the shares sum to min(total, sum of capacities). Rounding is
/// by largest remainder, ties to the lower index. Weights are positive where capacities are.
std::vector<int> Apportion(int total, std::span<const std::int64_t> weights,
                           std::span<const int> capacities);

/// A corner's score above the complement of its index: the higher goes first.
using CornerRank = std::uint64_t;

/// Picks corners of one level after another; keeps its buffers.
class GridSelector {
 public:
  /// Sets `chosen` to the ascending indices of min(quota, corners.size()) corners, spread over
  /// equal cells of about `cell_size` px that tile `area`. `corners` are in row-major order and lie
  /// in `area`. Every cell gives its k of highest score (or all it has) for the largest k that fits
  /// the quota; what remains goes to the highest of those next in their cells. Ties go to the lower
  /// index.
  void Select(std::span<const Corner> corners, const cv::Rect& area, int cell_size, int quota,
              std::vector<int>& chosen);

 private:
  /// Groups the corners' indices by cell.
  void SortIntoCells(std::span<const Corner> corners, const cv::Rect& area, int cell_size);
  /// The largest k for which the k best of every cell are at most `quota` together.
  int FullRounds(int quota);
  /// Marks the `rounds` best of every cell, and collects those that come next. Returns how many
  /// were marked.
  int MarkRounds(int rounds);
  /// Marks the best `count` of those collected.
  void MarkNext(int count);

  std::vector<int> column_of_x_;  ///< Cell column of area.x + i.
  std::vector<int> cell_of_;      ///< By corner.
  std::vector<int> cell_ends_;
  /// By cell: the members of c end where those of c + 1 begin.
  std::vector<CornerRank> members_;
  std::vector<int> cells_with_more_;
  std::vector<CornerRank> next_;
  std::vector<std::uint8_t> is_chosen_;
};

/// As GridSelector.
std::vector<int> SelectInGrid(std::span<const Corner> corners, const cv::Rect& area, int cell_size,
                              int quota);

/// Sets `chosen` to the ascending indices of the min(quota, corners.size()) corners of highest
/// score; ties go to the lower index.
void SelectStrongest(std::span<const Corner> corners, int quota, std::vector<int>& chosen);

}  // namespace corvo::orb
