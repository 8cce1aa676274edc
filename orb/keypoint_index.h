#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "orb/types.h"

namespace corvo::orb {

/// Finds the keypoints near a pixel, by cells of a grid over their bounding box. Copies what it
/// needs of the keypoints.
class KeypointIndex {
 public:
  KeypointIndex() = default;
  /// Keypoints may lie anywhere, but at finite coordinates; `cell_size_px` is positive (cells grow
  /// where keypoints lie far apart). Throws corvo::Error otherwise.
  explicit KeypointIndex(std::span<const Keypoint> keypoints, float cell_size_px = 24);

  /// Appends to `found` the indices of keypoints within `radius` px of (x, y) (Euclidean) whose
  /// octave is in [min_octave, max_octave], in ascending order.
  void Find(float x, float y, float radius, int min_octave, int max_octave,
            std::vector<int>& found) const;

  /// Number of keypoints.
  int size() const { return static_cast<int>(entries_.size()); }

 private:
  struct Entry {
    float x;
    float y;
    int octave;
    int index;
  };

  /// Lays cells over the keypoints' bounding box.
  void LayOut(std::span<const Keypoint> keypoints, double cell_size_px);
  int ColumnOf(double x) const;
  int RowOf(double y) const;

  double left_ = 0;
  double top_ = 0;
  double cell_size_ = 1;
  int columns_ = 0;
  int rows_ = 0;
  std::vector<int> cell_starts_;  ///< Cell c holds entries [cell_starts_[c], cell_starts_[c + 1]).
  std::vector<Entry> entries_;
};

}  // namespace corvo::orb
