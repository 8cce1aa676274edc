#pragma once

#include <Eigen/Core>

#include "vo/camera/camera.h"
#include "vo/lie/se3.h"

namespace corvo {

/// A known point, how well it is known, and where it was seen.
struct PointObservation {
  Eigen::Vector3d in_world;
  Eigen::Vector2d pixel;
  double sigma_px = 1;  ///< Standard deviation of the pixel, each axis.
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< Of `in_world`.
};

/// The error that an optimizer gives an observation whose point does not project, in standard
/// deviations: larger than that of any observation that is of use.
inline constexpr double kUnprojectableError = 1e3;

/// The squared reprojection error in units of sigma_px²; infinity where the point does not project.
double SquaredError(const PointObservation& observation, const SE3& camera_from_world,
                    const Camera& camera);

}  // namespace corvo
