// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "vo/core/trajectory.h"
#include "vo/map/segment_join.h"
#include "vo/offline/camera_path.h"

namespace corvo {

/// The length of the unit of a trajectory at one frame.
struct FrameScale {
  double meters_per_unit = 1;
  double log_sigma = 0;  ///< Standard deviation of its logarithm.
};

/// The scale of a monocular trajectory.
struct MetricScale {
  /// By the index of the frame. Frames without one keep their unit.
  std::vector<std::optional<FrameScale>> frames;
  /// Set if the scale was measured, rather than given.
  std::optional<ScaleSource> source;
};

/// Returns the same scale for all posed frames. Throws corvo::Error unless it is finite and above
/// 0.
MetricScale ConstantScale(const Trajectory& trajectory, double meters_per_unit);

/// Returns the scale with which the camera is `height_m` above the ground along its whole path; see
/// FindGround(). `points` are the landmarks of the map. Segments without a visible ground have no
/// scale. The standard deviation is that of the height in units of the trajectory; an error of
/// `height_m` is not in it. Throws corvo::Error unless `height_m` is finite and above 0.
MetricScale ScaleOfCameraHeight(const Trajectory& trajectory,
                                const std::vector<PointInSegment>& points, double height_m);

/// The scale of a segment, measured at one place of it.
struct ScaleMeasurement {
  int segment = 0;
  double frame = 0;  ///< Index of the frame; between two frames, a number between their indices.
  FrameScale scale;
};

/// Returns a scale that passes through measurements: between two of a segment, its logarithm is
/// linear in the index of the frame, so that a drift of the scale between them is undone; before
/// the first and after the last it is constant. Segments without a measurement have no scale. The
/// standard deviations follow from those of the measurements. Throws corvo::Error if two
/// measurements of a segment are of the same frame.
MetricScale InterpolateScale(const Trajectory& trajectory,
                             const std::vector<ScaleMeasurement>& measurements, ScaleSource source);

/// Brings a trajectory and its map to meters. Each step between frames is multiplied by its scale,
/// so that a drift of the scale is undone along the path. Rotations do not change.
class MetricTransform {
 public:
  /// `trajectory` is the one in units of its segments, and `scale` its scale.
  MetricTransform(const Trajectory& trajectory, MetricScale scale);

  /// Returns the trajectory in meters. The covariances of relative poses have the error of the
  /// scale in them. If the scale was measured, that of its segments says so.
  Trajectory Apply(Trajectory trajectory) const;

  const MetricScale& scale() const { return scale_; }

  /// Returns the meters per unit by the index of the frame: 1 where the scale is not known.
  std::vector<double> MetersPerUnit() const;

  /// Returns the position of a point in meters: scaled about the frame whose camera is nearest to
  /// it.
  Eigen::Vector3d ToMeters(const PointInSegment& point) const;

 private:
  /// Returns a position near a frame in meters.
  Eigen::Vector3d ToMeters(int frame, const Eigen::Vector3d& in_world) const;

  MetricScale scale_;
  std::vector<Eigen::Vector3d> offsets_;  // By the index of the frame, m.
  std::map<int, CameraPath> paths_;       // By segment, in units.
};

}  // namespace corvo
