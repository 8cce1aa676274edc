// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "vo/map/map.h"

namespace corvo {

/// Covariance of a landmark's position, the poses of its keyframes taken as exact. A observation
/// over the distance d along the direction r, to σ px, tells the place across r to σ d / f, f =
/// camera.focal(), and along r next to nothing, to 10 d:
///
///     C⁻¹ = Σ (f / (σ d))² (I - r rᵀ) + r rᵀ / (10 d)²
Eigen::Matrix3d LandmarkCovariance(const Map& map, const Landmark& landmark);

}  // namespace corvo
