// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "vo/map/map.h"

namespace corvo {

/// Returns the covariance of a landmark's position, with the poses of its keyframes taken as exact.
/// An observation at distance d along the direction r, with a standard deviation of σ px, has a
/// standard deviation of σ d / f across r, where f = camera.focal(), and of s d along r, where s =
/// options.sigma_along_ray:
///
///     C⁻¹ = Σ (f / (σ d))² (I - r rᵀ) + r rᵀ / (s d)²
Eigen::Matrix3d LandmarkCovariance(const Map& map, const Landmark& landmark);

}  // namespace corvo
