// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include <Eigen/Core>

#include "vo/lie/se3.h"

namespace corvo {

/// A ray through a camera and where that camera stands.
struct PosedRay {
  SE3 world_from_camera;
  Eigen::Vector2d ray;  ///< (x/z, y/z) in the camera.
};

/// The point whose images are nearest to both rays, by the sum of their squared distances in ray
/// coordinates (Lindstrom, "Triangulation made easy", CVPR 2010). None where the rays are parallel.
/// The point may lie behind a camera.
std::optional<Eigen::Vector3d> Triangulate(const PosedRay& a, const PosedRay& b);

/// Angle between the directions of two rays, radians: of rays that meet, the parallax there.
double RayAngle(const PosedRay& a, const PosedRay& b);

/// Angle at a point between two cameras' centers, radians.
double ParallaxAngle(const Eigen::Vector3d& in_world, const SE3& world_from_a,
                     const SE3& world_from_b);

}  // namespace corvo
