// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>

#include "vo/camera/camera_parameters.h"
#include "vo/camera/projection.h"

/// Field-of-view model (Devernay and Faugeras, "Straight lines have to be straight", 2001, equation
/// 13; "ATAN" in PTAM and the TUM-mono dataset):
///
///     (x, y) = atan(2 r tan(omega / 2)) / (omega r) (a, b)
///
/// At omega = 0 there is no distortion, and none that exceeds rounding below 1e-9: relative to r it
/// is omega² (1 - 4 r²) / 12. There omega has no effect.
namespace corvo::fov {

Distorted Distort(const CameraParameters& parameters, const Eigen::Vector2d& undistorted);

/// Returns the derivative of the distorted point by omega.
Eigen::Vector2d DistortedByOmega(const CameraParameters& parameters,
                                 const Eigen::Vector2d& undistorted);

/// Returns the tangent of kMaxAngle, since the model has no limit of its own.
double MaxRadius(const CameraParameters& parameters);

/// Returns the undistorted point within `max_radius` that is distorted to `target`, exact to
/// rounding, or std::nullopt if there is none.
std::optional<Eigen::Vector2d> Undistort(const CameraParameters& parameters, double max_radius,
                                         const Eigen::Vector2d& target);

}  // namespace corvo::fov
