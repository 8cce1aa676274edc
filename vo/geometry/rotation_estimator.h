// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vo/geometry/ray_match.h"
#include "vo/lie/so3.h"

namespace corvo {

/// Rotation between two views that explains the matches best if the camera did not move: least
/// squares over unit rays (Kabsch), reweighted towards the median so that half of the matches may
/// be wrong. Returns second_from_first.
SO3 EstimateRotation(const std::vector<RayMatch>& matches);

/// Angle between each first ray, rotated, and the second: the parallax, radians.
std::vector<double> ComputeParallax(const std::vector<RayMatch>& matches,
                                    const SO3& second_from_first);

/// Rotation between two views that explains the matches best if the camera may have moved, too
/// little for the motion to be told: a camera turned by hand always does, and EstimateRotation
/// takes the common part of its parallax for rotation. Least robust (Cauchy) Sampson error over
/// rotation and direction of the baseline (Hartley and Zisserman, 11.4.3), from the rotation given
/// and baselines along each axis. The rotation given is a measurement, too, with
/// `common_parallax` times the median of the parallax it leaves as its standard deviation: a small
/// turn and a small move aside look alike, and the epipolar lines alone may tell them apart wrongly
/// by any angle.
SO3 RefineRotation(const std::vector<RayMatch>& matches, const SO3& second_from_first,
                   double common_parallax = 4);

}  // namespace corvo
