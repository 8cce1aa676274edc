// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <vector>

#include <Eigen/Core>

#include "vo/geometry/ray_match.h"
#include "vo/lie/so3.h"
#include "vo/math/levenberg_marquardt.h"

namespace corvo {

/// A motion between two views up to the length of its translation: the essential matrix is
/// [baseline]x R.
struct EpipolarMotion {
  SO3 second_from_first;
  Eigen::Vector3d baseline;  ///< Unit vector to the first camera, in the second's frame.
};

/// Returns the motion of least robust (Cauchy) Sampson error that is reached from `start` (Hartley
/// and Zisserman, 11.4.3), and its cost: the sum of log(1 + e²), with e in units of the sigma of
/// each match. The rotation of `start` is a measurement, too, with a standard deviation of
/// `rotation_sigma` about each axis, radians.
Minimum<EpipolarMotion> FitEpipolarMotion(
    const std::vector<RayMatch>& matches, const EpipolarMotion& start,
    double rotation_sigma = std::numeric_limits<double>::infinity());

/// Returns what FitEpipolarMotion() reaches from a rotation with a baseline along each axis.
std::vector<Minimum<EpipolarMotion>> FitEpipolarMotionsAlongAxes(
    const std::vector<RayMatch>& matches, const SO3& second_from_first,
    double rotation_sigma = std::numeric_limits<double>::infinity());

}  // namespace corvo
