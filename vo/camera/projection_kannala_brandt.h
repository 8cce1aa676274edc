// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>

#include "vo/camera/camera_parameters.h"
#include "vo/camera/projection.h"

/// Kannala-Brandt fisheye model with four coefficients (Kannala and Brandt, "A Generic Camera Model
/// and Calibration Method for Conventional, Wide-Angle, and Fish-Eye Lenses", 2006; OpenCV's
/// fisheye, Kalibr's "equidistant"). With theta = atan(r):
///
///     d(theta) = theta (1 + k1 theta² + k2 theta⁴ + k3 theta⁶ + k4 theta⁸)
///     (x, y) = d(theta) / r (a, b)
namespace corvo::kannala_brandt {

Distorted Distort(const CameraParameters& parameters, const Eigen::Vector2d& undistorted);

/// Returns the derivative of the distorted point by the coefficient ki, i = 1 to 4.
Eigen::Vector2d DistortedByCoefficient(int i, const Eigen::Vector2d& undistorted);

/// Returns the tangent of the angle up to which d grows, at most kMaxAngle.
double MaxRadius(const CameraParameters& parameters);

/// Returns the undistorted point within `max_radius` that is distorted to `target`, exact to
/// rounding, or std::nullopt if there is none.
std::optional<Eigen::Vector2d> Undistort(const CameraParameters& parameters, double max_radius,
                                         const Eigen::Vector2d& target);

}  // namespace corvo::kannala_brandt
