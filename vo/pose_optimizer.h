#pragma once

#include <vector>

#include <Eigen/Core>

#include "vo/camera.h"
#include "vo/lie/se3.h"
#include "vo/options.h"

namespace corvo {

/// A known point and where it was seen.
struct PointObservation {
  Eigen::Vector3d in_world;
  Eigen::Vector2d pixel;
  double sigma_px = 1;  ///< Standard deviation of the pixel, each axis.
};

struct PoseEstimate {
  SE3 world_from_camera;
  std::vector<char> is_inlier;  ///< One an observation.
  int num_inliers = 0;
};

/// The squared reprojection error in units of sigma²; infinity where the point does not project.
double SquaredError(const PointObservation& observation, const SE3& camera_from_world,
                    const Camera& camera);

/// The pose that minimises the robust reprojection error of known points, by Levenberg-Marquardt
/// from `initial`. In each of four rounds observations over the 95% quantile of χ² with two degrees
/// of freedom are set aside and may return in the next; the first two rounds are Huber-robust.
PoseEstimate OptimizePose(const SE3& initial, const std::vector<PointObservation>& observations,
                          const Camera& camera);

}  // namespace corvo
