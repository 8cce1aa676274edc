// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include <Eigen/Core>

#include "vo/lie/se3.h"

namespace corvo {

/// A ray and the pose of its camera.
struct PosedRay {
  SE3 world_from_camera;
  Eigen::Vector2d ray;  ///< (x/z, y/z) in the camera.
};

/// Returns the point whose projections are nearest to both rays, by the sum of their squared
/// distances in ray coordinates (Lindstrom, "Triangulation made easy", CVPR 2010), or std::nullopt
/// if the rays are parallel. The point may lie behind a camera.
std::optional<Eigen::Vector3d> Triangulate(const PosedRay& a, const PosedRay& b);

/// Returns the angle between the directions of two rays, radians. If the rays intersect, it is the
/// parallax of their intersection.
double RayAngle(const PosedRay& a, const PosedRay& b);

/// Returns the angle at a point between two camera centers, radians.
double ParallaxAngle(const Eigen::Vector3d& in_world, const SE3& world_from_a,
                     const SE3& world_from_b);

}  // namespace corvo
