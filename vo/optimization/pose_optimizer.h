// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "vo/camera/camera.h"
#include "vo/core/options.h"
#include "vo/lie/se3.h"
#include "vo/map/observation.h"

namespace corvo {

/// An observed point and its covariance.
struct KnownPoint {
  Eigen::Vector3d in_world;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< Covariance of `in_world`.
};

/// Points and their observations in one frame: observation i is of point i.
struct PoseObservations {
  std::vector<KnownPoint> points;
  std::vector<Observation> observations;

  std::size_t size() const { return points.size(); }
  void Add(const KnownPoint& point, const Observation& observation) {
    points.push_back(point);
    observations.push_back(observation);
  }
};

struct PoseEstimate {
  SE3 world_from_camera;
  std::vector<char> is_inlier;  ///< One for each observation.
  int num_inliers = 0;
};

/// Returns the pose that minimizes the robust reprojection error of known points, by
/// Levenberg-Marquardt from `initial`. A residual is weighted by the inverse of
///
///     sigma_px² I + J C Jᵀ,   J = d pixel / d in_world at `initial`,
///
/// where C is the covariance of the point: a point that is well determined for the views that
/// observed it may be poorly determined for others. In each round, observations whose SquaredError
/// exceeds the 95% quantile of χ² with two degrees of freedom are excluded; they may be included
/// again in the next round. The first rounds use Huber's loss.
PoseEstimate OptimizePose(const SE3& initial, const PoseObservations& observations,
                          const Camera& camera, const PoseOptimizerOptions& options = {});

}  // namespace corvo
