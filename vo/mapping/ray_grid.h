// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include <Eigen/Core>

#include "orb/types.h"
#include "vo/map/frame.h"
#include "vo/map/measurement_model.h"

namespace corvo {

/// The keypoints of a frame that observe no landmark, as arrays for the inner loops.
struct UnmatchedKeypoints {
  std::vector<int> index;  ///< Keypoint indices in the frame.
  std::vector<orb::Descriptor> descriptors;
  std::vector<double> x;          ///< x/z of the rays.
  std::vector<double> y;          ///< y/z of the rays.
  std::vector<double> variances;  ///< Variances of the rays along each axis.
  std::vector<double> octave_scales;

  int size() const { return static_cast<int>(index.size()); }
};

UnmatchedKeypoints CollectUnmatched(const Frame& frame, const MeasurementModel& model);

/// A segment of a line a x + b y + c = 0 in the plane of rays (x/z, y/z).
struct EpipolarSegment {
  Eigen::Vector2d near;  ///< The image of the nearest point.
  Eigen::Vector2d far;   ///< The image of the farthest point.
  Eigen::Vector3d line;  ///< (a, b, c).
};

/// A grid of cells that finds the rays near a segment.
class RayGrid {
 public:
  /// `cell_size` is the side of a cell, in units of rays.
  RayGrid(UnmatchedKeypoints points, double cell_size);

  /// Returns the points, sorted by cell.
  const UnmatchedKeypoints& points() const { return points_; }

  /// Returns the indices of the points that lie within the 95% quantile of their distance from the
  /// segment's line, in the cells around the segment. The indices are stored in `buffer`, which
  /// must have room for one more than all points.
  std::span<int> Find(const EpipolarSegment& segment, std::vector<int>& buffer) const;

 private:
  int CellOf(double offset, int count) const;
  int RowOf(double y) const { return CellOf(y - origin_.y(), rows_); }
  int ColumnOf(double x) const { return CellOf(x - origin_.x(), columns_); }
  void SortIntoCells();
  /// Appends the points from `begin` to `end` that are near a line to the first `count` entries of
  /// a buffer, and returns the new count.
  int AppendNear(const Eigen::Vector3d& line, int begin, int end, std::vector<int>& buffer,
                 int count) const;

  UnmatchedKeypoints points_;
  std::vector<double> max_squared_distances_;  // Largest from a line, by point.
  double margin_ = 0;                          // Largest distance of any point from a line.
  double cell_size_;
  double cells_per_unit_;
  Eigen::Vector2d origin_ = Eigen::Vector2d::Zero();
  int columns_ = 0;
  int rows_ = 0;
  std::vector<int> starts_;  // Cell c holds points starts_[c] to starts_[c + 1] - 1.
};

}  // namespace corvo
