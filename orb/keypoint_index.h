// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "orb/types.h"

namespace corvo::orb {

/// A search window for keypoints: a disc in an image and a range of octaves.
struct SearchWindow {
  float x = 0;
  float y = 0;
  float radius = 0;  ///< px
  int min_octave = 0;
  int max_octave = 0;
};

/// Finds the keypoints near a pixel with a grid of cells over their bounding box. Copies the data
/// that it needs from the keypoints.
class KeypointIndex {
 public:
  KeypointIndex() = default;
  /// Keypoints may lie anywhere; `cell_size_px` is the minimum side of a cell (cells are larger if
  /// the bounding box would need too many). Throws corvo::Error if a coordinate is not finite or
  /// `cell_size_px` is not positive.
  explicit KeypointIndex(std::span<const Keypoint> keypoints, float cell_size_px = 24);

  /// Appends the indices of the keypoints within the window (Euclidean distance, inclusive range of
  /// octaves) to `found`, in ascending order.
  void Find(const SearchWindow& window, std::vector<int>& found) const;

  /// Like Find(), but in unspecified order.
  void FindUnordered(const SearchWindow& window, std::vector<int>& found) const;

  /// Returns the number of keypoints.
  int size() const { return cell_starts_.empty() ? 0 : cell_starts_.back(); }

  /// Returns the memory held beyond the object itself, bytes.
  std::size_t num_bytes() const {
    return sizeof(int) * (cell_starts_.capacity() + octaves_.capacity() + indices_.capacity()) +
           sizeof(float) * (x_.capacity() + y_.capacity());
  }

 private:
  /// Sets the cells that cover the keypoints' bounding box.
  void LayOut(std::span<const Keypoint> keypoints, double cell_size_px);
  /// Groups the keypoints by cell, keeping their order within a cell.
  void SortIntoCells(std::span<const Keypoint> keypoints);
  int ColumnOf(double x) const;
  int RowOf(double y) const;

  double left_ = 0;
  double top_ = 0;
  double cells_per_px_ = 1;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<int> cell_starts_;  ///< First entry of each cell, then the number of entries.
  std::vector<float> x_;          ///< Columns of the keypoints, grouped by cell, then padding.
  std::vector<float> y_;
  std::vector<int> octaves_;
  std::vector<int> indices_;
};

}  // namespace corvo::orb
