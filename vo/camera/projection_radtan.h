// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>

#include "vo/camera/camera_parameters.h"
#include "vo/camera/projection.h"

/// Radial-tangential distortion (Brown-Conrady, OpenCV's convention). With r² = a² + b² and
/// c = 1 + k1 r² + k2 r⁴ + k3 r⁶:
///
///     x = a c + 2 p1 a b + p2 (r² + 2 a²)
///     y = b c + p1 (r² + 2 b²) + 2 p2 a b
namespace corvo::radtan {

Distorted Distort(const CameraParameters& parameters, const Eigen::Vector2d& undistorted);

/// Returns the radius r up to which r c grows with r; beyond it, rays would meet the image twice.
/// Infinity if r c always grows.
double MaxRadius(const CameraParameters& parameters);

/// Returns the undistorted point within `max_radius` that is distorted to `target`, exact to
/// rounding, or std::nullopt if there is none.
std::optional<Eigen::Vector2d> Undistort(const CameraParameters& parameters, double max_radius,
                                         const Eigen::Vector2d& target);

}  // namespace corvo::radtan
