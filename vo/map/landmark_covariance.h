// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "vo/map/map.h"

namespace corvo {

/// Returns the information of one observation about the position of its landmark, with the pose of
/// its keyframe taken as exact. An observation at distance d along the direction r, with a standard
/// deviation of σ px, has a standard deviation of σ d / f across r, where f = camera.focal(), and
/// of s d along r, where s = options.sigma_along_ray:
///
///     I = (f / (σ d))² (1 - r rᵀ) + r rᵀ / (s d)²
Eigen::Matrix3d LandmarkInformation(const Map& map, const Landmark& landmark,
                                    const TrackElement& observation);

/// Returns the covariance of a landmark's position, with the poses of its keyframes taken as exact:
/// the inverse of the sum of the LandmarkInformation of its observations.
Eigen::Matrix3d LandmarkCovariance(const Map& map, const Landmark& landmark);

}  // namespace corvo
