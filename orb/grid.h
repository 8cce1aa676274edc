// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <opencv2/core/types.hpp>

#include "orb/fast.h"

namespace corvo::orb {

/// A corner's score (upper 32 bits) and the complement of its index (lower 32 bits). Higher ranks
/// are selected first.
using CornerRank = std::uint64_t;

/// Selects well-distributed corners in one pyramid level at a time. Keeps its buffers; not
/// thread-safe.
class GridSelector {
 public:
  /// Sets `chosen` to the ascending indices of min(quota, corners.size()) corners, spread over
  /// equal cells of about `cell_size` px that tile `area`. `corners` are in row-major order and lie
  /// in `area`. Each cell contributes its k corners of highest score (or all it has), with the
  /// largest k that does not exceed the quota; the rest of the quota is filled with the highest
  /// scores among each cell's next corner. Ties go to the lower index.
  void Select(std::span<const Corner> corners, const cv::Rect& area, int cell_size, int quota,
              std::vector<int>& chosen);

 private:
  /// Computes the cell of each corner and the number of corners of each cell, as cell_ends_.
  void FindCells(std::span<const Corner> corners, const cv::Rect& area, int cell_size);
  /// Collects the best corner of each cell in next_.
  void FindBest(std::span<const Corner> corners);
  /// Groups the corners by cell.
  void GroupByCell(std::span<const Corner> corners);
  /// Returns the largest k for which the k best corners of every cell do not exceed `quota` in
  /// total.
  int FullRounds(int quota);
  /// Appends the `rounds` best corners of every cell to `chosen`, and collects each cell's next
  /// corner in next_.
  void TakeRounds(int rounds, std::vector<int>& chosen);
  /// Appends the best `count` corners of next_ to `chosen`.
  void TakeNext(int count, std::vector<int>& chosen);
  /// Sorts indices, all different, of `num_corners` corners.
  void Sort(std::size_t num_corners, std::vector<int>& chosen);

  std::vector<int> column_of_x_;  ///< The cell column of image column area.x + i.
  std::vector<int> cell_of_;      ///< The cell index, by corner.
  std::vector<CornerRank> best_;  ///< The best rank, by cell; 0 if it is empty.
  std::vector<int> cell_ends_;
  std::vector<CornerRank> members_;  ///< Grouped by cell; cell c ends at cell_ends_[c].
  std::vector<int> cells_with_more_;
  std::vector<CornerRank> next_;
  std::vector<std::uint64_t> is_chosen_;  ///< A bit for each corner.
};

/// Returns the indices that GridSelector::Select() chooses.
std::vector<int> SelectInGrid(std::span<const Corner> corners, const cv::Rect& area, int cell_size,
                              int quota);

/// Sets `chosen` to the ascending indices of the min(quota, corners.size()) corners of highest
/// score; ties go to the lower index.
void SelectStrongest(std::span<const Corner> corners, int quota, std::vector<int>& chosen);

}  // namespace corvo::orb
