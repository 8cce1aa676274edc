// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "orb/types.h"

namespace corvo::orb {

/// Where to look for keypoints: a disc in an image and a range of octaves.
struct SearchWindow {
  float x = 0;
  float y = 0;
  float radius = 0;  ///< px
  int min_octave = 0;
  int max_octave = 0;
};

/// Finds the keypoints near a pixel, by cells of a grid over their bounding box. Copies what it
/// needs of the keypoints.
class KeypointIndex {
 public:
  KeypointIndex() = default;
  /// Keypoints may lie anywhere, but at finite coordinates; `cell_size_px` is positive (cells grow
  /// where keypoints lie far apart). Throws corvo::Error otherwise.
  explicit KeypointIndex(std::span<const Keypoint> keypoints, float cell_size_px = 24);

  /// Appends to `found` the indices of keypoints within the window (Euclidean distance, inclusive
  /// range of octaves), in ascending order.
  void Find(const SearchWindow& window, std::vector<int>& found) const;

  /// As Find, but in any order.
  void FindUnordered(const SearchWindow& window, std::vector<int>& found) const;

  /// Number of keypoints.
  int size() const { return cell_starts_.empty() ? 0 : cell_starts_.back(); }

  /// Memory held beyond the object itself.
  std::size_t num_bytes() const {
    return sizeof(int) * (cell_starts_.capacity() + octaves_.capacity() + indices_.capacity()) +
           sizeof(float) * (x_.capacity() + y_.capacity());
  }

 private:
  /// Lays cells over the keypoints' bounding box.
  void LayOut(std::span<const Keypoint> keypoints, double cell_size_px);
  /// Sorts keypoints into the cells, those of a cell in their own order.
  void SortIntoCells(std::span<const Keypoint> keypoints);
  int ColumnOf(double x) const;
  int RowOf(double y) const;

  double left_ = 0;
  double top_ = 0;
  double cells_per_px_ = 1;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<int> cell_starts_;  ///< Cell c holds keypoints cell_starts_[c] to [c + 1] - 1.
  std::vector<float> x_;          ///< Of the keypoints by cells; some more behind the last.
  std::vector<float> y_;
  std::vector<int> octaves_;
  std::vector<int> indices_;
};

}  // namespace corvo::orb
