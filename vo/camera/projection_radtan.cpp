// SPDX-License-Identifier: MIT
#include "vo/camera/projection_radtan.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace corvo::radtan {
namespace {

/// Returns c(s) = 1 + k1 s + k2 s² + k3 s³, s = r².
double RadialFactor(const CameraParameters& p, double s) {
  return 1 + s * (p.k1 + s * (p.k2 + s * p.k3));
}

/// Returns d(r c(r²))/dr as a function of s = r².
double RadialSlope(const CameraParameters& p, double s) {
  return 1 + s * (3 * p.k1 + s * (5 * p.k2 + s * 7 * p.k3));
}

/// Returns the positive s, in ascending order, between which RadialSlope is monotonic: the roots of
/// its derivative 3 k1 + 10 k2 s + 21 k3 s².
std::vector<double> SlopeTurns(const CameraParameters& p) {
  std::array<double, 2> roots = {0, 0};
  const double discriminant = 25 * p.k2 * p.k2 - 63 * p.k1 * p.k3;
  if (discriminant >= 0) {
    const double q = -(5 * p.k2 + std::copysign(std::sqrt(discriminant), p.k2));
    roots = {q / (21 * p.k3), 3 * p.k1 / q};
  }
  std::vector<double> turns;
  for (const double root : roots) {
    if (root > 0 && std::isfinite(root)) turns.push_back(root);
  }
  std::sort(turns.begin(), turns.end());
  return turns;
}

/// Returns the s between `low` (slope > 0) and `high` (slope <= 0) at which RadialSlope falls to 0.
double BisectSlope(const CameraParameters& p, double low, double high) {
  for (double middle = 0.5 * (low + high); middle > low && middle < high;
       middle = 0.5 * (low + high)) {
    (RadialSlope(p, middle) > 0 ? low : high) = middle;
  }
  return low;
}

/// Returns the r in [0, max_radius] with r c(r²) = distorted_radius, or about max_radius if there
/// is none.
double UndistortRadius(const CameraParameters& p, double max_radius, double distorted_radius) {
  return InvertIncreasing([&p](double r) { return r * RadialFactor(p, r * r); },
                          [&p](double r) { return RadialSlope(p, r * r); }, max_radius,
                          distorted_radius);
}

/// Applies Newton's method to the complete model from a close start. Returns std::nullopt unless it
/// converges inside max_radius.
std::optional<Eigen::Vector2d> UndistortFrom(const CameraParameters& p, double max_radius,
                                             const Eigen::Vector2d& target, Eigen::Vector2d point) {
  for (int i = 0; i < kMaxUndistortionIterations; ++i) {
    const Distorted distorted = Distort(p, point);
    const Eigen::Vector2d step = distorted.jacobian.inverse() * (target - distorted.point);
    point += step;
    if (!point.allFinite()) return std::nullopt;
    if (step.norm() > kTolerance * (1 + point.norm())) continue;
    if (point.norm() < max_radius) return point;
    return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

Distorted Distort(const CameraParameters& p, const Eigen::Vector2d& undistorted) {
  const double a = undistorted.x(), b = undistorted.y();
  const double s = a * a + b * b;
  const double c = RadialFactor(p, s);
  const double dc = 2 * (p.k1 + s * (2 * p.k2 + s * 3 * p.k3));  // (dc/da)/a = (dc/db)/b
  const double cross = dc * a * b + 2 * (p.p1 * a + p.p2 * b);
  Distorted out;
  out.point << a * c + 2 * p.p1 * a * b + p.p2 * (s + 2 * a * a),
      b * c + p.p1 * (s + 2 * b * b) + 2 * p.p2 * a * b;
  out.jacobian << c + dc * a * a + 2 * p.p1 * b + 6 * p.p2 * a, cross,  //
      cross, c + dc * b * b + 6 * p.p1 * b + 2 * p.p2 * a;
  return out;
}

double MaxRadius(const CameraParameters& p) {
  double low = 0;
  for (const double turn : SlopeTurns(p)) {
    if (RadialSlope(p, turn) <= 0) return std::sqrt(BisectSlope(p, low, turn));
    low = turn;
  }
  const double leading = p.k3 != 0 ? p.k3 : p.k2 != 0 ? p.k2 : p.k1;
  if (leading >= 0) return std::numeric_limits<double>::infinity();
  double high = std::max(1.0, 2 * low);
  while (RadialSlope(p, high) > 0) high *= 2;
  return std::sqrt(BisectSlope(p, low, high));
}

std::optional<Eigen::Vector2d> Undistort(const CameraParameters& p, double max_radius,
                                         const Eigen::Vector2d& target) {
  const double radius = target.norm();
  if (radius == 0) return UndistortFrom(p, max_radius, target, target);
  const double start = UndistortRadius(p, max_radius, radius) / radius;
  return UndistortFrom(p, max_radius, target, start * target);
}

}  // namespace corvo::radtan
