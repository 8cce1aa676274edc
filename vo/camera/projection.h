// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace corvo {

/// What the projections of all camera models share. Each takes an undistorted point
/// (a, b) = (x/z, y/z) to a distorted one, in which the image is fx, fy, cx, cy away; r, the
/// distance from the axis, is tan(theta) for the angle theta between ray and axis.

/// A wide lens is used up to this angle from its axis, radians (80 degrees): rays are kept as
/// (x/z, y/z), whose noise grows without bound towards 90.
inline constexpr double kMaxAngle = 80 * std::numbers::pi / 180;

/// Distorted coordinates, and their derivative by the undistorted ones.
struct Distorted {
  Eigen::Vector2d point;
  Eigen::Matrix2d jacobian;
};

/// The point moved along its radius from r to `radius` = g(r), where `slope` = dg/dr.
inline Distorted MoveRadially(const Eigen::Vector2d& undistorted, double r, double radius,
                              double slope) {
  if (r == 0) return {slope * undistorted, slope * Eigen::Matrix2d::Identity()};
  const Eigen::Vector2d outwards = undistorted / r;
  const double scale = radius / r;
  return {scale * undistorted,
          scale * Eigen::Matrix2d::Identity() + (slope - scale) * outwards * outwards.transpose()};
}

inline constexpr int kMaxIterations = 50;
inline constexpr double kTolerance = 1e-12;  ///< Of a coordinate, relative to 1 + itself.

/// The t in [0, high] with value(t) = `target`, by Newton inside a shrinking bracket; about `high`
/// where there is none. `value` grows with t from value(0) = 0; `slope` is its derivative.
template <typename Value, typename Slope>
double InvertIncreasing(const Value& value, const Slope& slope, double high, double target) {
  double low = 0, t = std::min(target, high);
  for (int i = 0; i < kMaxIterations; ++i) {
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
