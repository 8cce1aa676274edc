// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vo/geometry/ray_match.h"
#include "vo/lie/so3.h"

namespace corvo {

/// Returns second_from_first, the rotation that best explains the matches of two views if the
/// camera did not move: least squares over unit rays (Kabsch), reweighted relative to the median so
/// that half of the matches may be wrong.
SO3 EstimateRotation(const std::vector<RayMatch>& matches);

/// Returns the angle between each first ray, rotated, and the second ray: the parallax, radians.
std::vector<double> ComputeParallax(const std::vector<RayMatch>& matches,
                                    const SO3& second_from_first);

/// Returns the rotation that best explains the matches of two views if the camera may have moved,
/// but too little to estimate the motion. A camera turned by hand always moves, and
/// EstimateRotation attributes the common part of its parallax to the rotation.
///
/// Minimizes the robust (Cauchy) Sampson error over the rotation and the direction of the baseline
/// (Hartley and Zisserman, 11.4.3), starting from the given rotation and a baseline along each
/// axis. The given rotation is a measurement, too; its standard deviation is `common_parallax`
/// times the median parallax that it leaves. Without it, the rotation could be wrong by any angle,
/// since the epipolar lines of a small rotation and of a small sideways motion are alike.
SO3 RefineRotation(const std::vector<RayMatch>& matches, const SO3& second_from_first,
                   double common_parallax = 4);

}  // namespace corvo
