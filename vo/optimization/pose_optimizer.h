#pragma once

#include <vector>

#include <Eigen/Core>

#include "vo/camera/camera.h"
#include "vo/core/options.h"
#include "vo/lie/se3.h"

namespace corvo {

/// A known point, how well it is known, and where it was seen.
struct PointObservation {
  Eigen::Vector3d in_world;
  Eigen::Vector2d pixel;
  double sigma_px = 1;  ///< Standard deviation of the pixel, each axis.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< Of `in_world`.
};

struct PoseEstimate {
  SE3 world_from_camera;
  std::vector<char> is_inlier;  ///< One an observation.
  int num_inliers = 0;
};

/// The squared reprojection error in units of sigma_px²; infinity where the point does not project.
double SquaredError(const PointObservation& observation, const SE3& camera_from_world,
                    const Camera& camera);

/// The pose that minimises the robust reprojection error of known points, by Levenberg-Marquardt
/// from `initial`. A residual weighs by the inverse of sigma_px² I + J C Jᵀ, of a point with the
/// covariance C, J = d pixel / d in_world at `initial`: what is known well where it was seen before
/// may be known badly from elsewhere. In each of four rounds observations whose SquaredError is
/// over the 95% quantile of χ² with two degrees of freedom are set aside and may return in the
/// next; the first two rounds are Huber-robust.
PoseEstimate OptimizePose(const SE3& initial, const std::vector<PointObservation>& observations,
                          const Camera& camera);

}  // namespace corvo
