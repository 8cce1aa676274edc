// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <opencv2/core/types.hpp>

#include "orb/fast.h"

namespace corvo::orb {

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
  /// Sets the cell of each corner, and the best corner of each cell.
  void FindCells(std::span<const Corner> corners, const cv::Rect& area, int cell_size);
  /// Groups the corners by cell.
  void GroupByCell(std::span<const Corner> corners);
  /// The largest k for which the k best of every cell are at most `quota` together.
  int FullRounds(int quota);
  /// Appends the `rounds` best of every cell to `chosen`, and collects those that come next.
  void TakeRounds(int rounds, std::vector<int>& chosen);
  /// Appends the best `count` of those collected.
  void TakeNext(int count, std::vector<int>& chosen);

  std::vector<int> column_of_x_;  ///< Cell column of area.x + i.
  std::vector<int> cell_of_;      ///< By corner.
  std::vector<CornerRank> best_;  ///< By cell; 0 where it is empty.
  std::vector<int> cell_ends_;
  std::vector<CornerRank> members_;  ///< Those of a cell end where those of the next begin.
  std::vector<int> cells_with_more_;
  std::vector<CornerRank> next_;
};

/// As GridSelector.
std::vector<int> SelectInGrid(std::span<const Corner> corners, const cv::Rect& area, int cell_size,
                              int quota);

/// Sets `chosen` to the ascending indices of the min(quota, corners.size()) corners of highest
/// score; ties go to the lower index.
void SelectStrongest(std::span<const Corner> corners, int quota, std::vector<int>& chosen);

}  // namespace corvo::orb
