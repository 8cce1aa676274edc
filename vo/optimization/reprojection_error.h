// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "vo/camera/camera.h"
#include "vo/map/observation.h"

namespace corvo {

/// The error, in standard deviations, that an optimizer assigns to an observation whose point does
/// not project. It is larger than that of any useful observation.
inline constexpr double kUnprojectableError = 1e3;

/// Returns the squared reprojection error of a point in units of the observation's sigma_px², or
/// infinity if the point does not project.
double SquaredError(const Eigen::Vector3d& in_camera, const Observation& observation,
                    const Camera& camera);

}  // namespace corvo
