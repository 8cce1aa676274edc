// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "vo/camera/camera.h"
#include "vo/map/observation.h"

namespace corvo {

/// The error that an optimizer gives an observation whose point does not project, in standard
/// deviations: larger than that of any observation that is of use.
inline constexpr double kUnprojectableError = 1e3;

/// The squared reprojection error of a point in units of the observation's sigma_px²; infinity
/// where the point does not project.
double SquaredError(const Eigen::Vector3d& in_camera, const Observation& observation,
                    const Camera& camera);

}  // namespace corvo
