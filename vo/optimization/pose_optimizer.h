#pragma once

#include <vector>

#include "vo/camera/camera.h"
#include "vo/core/options.h"
#include "vo/lie/se3.h"
#include "vo/optimization/reprojection_error.h"

namespace corvo {

struct PoseEstimate {
  SE3 world_from_camera;
  std::vector<char> is_inlier;  ///< One for each observation.
  int num_inliers = 0;
};

/// The pose that minimizes the robust reprojection error of known points, by Levenberg-Marquardt
/// from `initial`. A residual is weighted by the inverse of sigma_px² I + J C Jᵀ for a point with
/// the covariance C, J = d pixel / d in_world at `initial`: a point that is known well where it was
/// seen before may be known badly from elsewhere. In each round, observations whose SquaredError is
/// over the 95% quantile of χ² with two degrees of freedom are set aside, and may return in the
/// next; the first rounds use Huber's loss.
PoseEstimate OptimizePose(const SE3& initial, const std::vector<PointObservation>& observations,
                          const Camera& camera, const PoseOptimizerOptions& options = {});

}  // namespace corvo
