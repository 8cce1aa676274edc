// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace corvo {

/// Common parts of the projections of all camera models. Each projection maps an undistorted point
/// (a, b) = (x/z, y/z) to a distorted point, which fx, fy, cx and cy map to a pixel; r, the
/// distance from the axis, is tan(theta) for the angle theta between ray and axis.

/// The largest angle from the axis at which a wide lens is used, radians (80 degrees): rays are
/// stored as (x/z, y/z), whose noise grows without bound toward 90 degrees.
inline constexpr double kMaxAngle = 80 * std::numbers::pi / 180;

/// The distorted coordinates and their derivative with respect to the undistorted ones.
struct Distorted {
  Eigen::Vector2d point;
  Eigen::Matrix2d jacobian;
};

/// Returns the point moved along its radius from r to `radius` = g(r), where `slope` = dg/dr.
inline Distorted MoveRadially(const Eigen::Vector2d& undistorted, double r, double radius,
                              double slope) {
  if (r == 0) return {slope * undistorted, slope * Eigen::Matrix2d::Identity()};
  const Eigen::Vector2d outwards = undistorted / r;
  const double scale = radius / r;
  return {scale * undistorted,
          scale * Eigen::Matrix2d::Identity() + (slope - scale) * outwards * outwards.transpose()};
}

inline constexpr int kMaxUndistortionIterations = 50;
inline constexpr double kTolerance = 1e-12;  ///< Final step size relative to 1 + coordinate.

/// Returns the t in [0, high] with value(t) = `target`, found by Newton's method inside a shrinking
/// bracket, or about `high` if there is none. `value` grows with t from value(0) = 0; `slope` is
/// its derivative.
template <typename Value, typename Slope>
double InvertIncreasing(const Value& value, const Slope& slope, double high, double target) {
  double low = 0, t = std::min(target, high);
  for (int i = 0; i < kMaxUndistortionIterations; ++i) {
    const double error = value(t) - target;
    (error < 0 ? low : high) = t;
    const double step = error / slope(t);
    if (std::abs(step) <= kTolerance * (1 + t)) break;
    t -= step;
    if (t > low && t < high) continue;
    t = std::isfinite(high) ? 0.5 * (low + high) : 2 * low;
  }
  return t;
}

}  // namespace corvo
