// SPDX-License-Identifier: MIT
#include "vo/camera/projection_kannala_brandt.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace corvo::kannala_brandt {
namespace {

/// Returns d(theta).
double DistortAngle(const CameraParameters& p, double theta) {
  const double s = theta * theta;
  return theta * (1 + s * (p.k1 + s * (p.k2 + s * (p.k3 + s * p.k4))));
}

/// Returns dd/dtheta.
double AngleSlope(const CameraParameters& p, double theta) {
  const double s = theta * theta;
  return 1 + s * (3 * p.k1 + s * (5 * p.k2 + s * (7 * p.k3 + s * 9 * p.k4)));
}

/// Returns the value at s of a polynomial with these coefficients, lowest degree first.
double Evaluate(const std::vector<double>& coefficients, double s) {
  double value = 0;
  for (auto c = coefficients.rbegin(); c != coefficients.rend(); ++c) value = value * s + *c;
  return value;
}

std::vector<double> Differentiate(const std::vector<double>& coefficients) {
  std::vector<double> derivative;
  for (std::size_t i = 1; i < coefficients.size(); ++i) {
    derivative.push_back(static_cast<double>(i) * coefficients[i]);
  }
  return derivative;
}

/// Returns the position between `low` and `high` at which the sign of a polynomial changes.
double Bisect(const std::vector<double>& coefficients, double low, double high) {
  const bool is_positive = Evaluate(coefficients, low) > 0;
  for (double middle = 0.5 * (low + high); middle > low && middle < high;
       middle = 0.5 * (low + high)) {
    ((Evaluate(coefficients, middle) > 0) == is_positive ? low : high) = middle;
  }
  return low;
}

/// Returns the positions in (0, end) at which the sign of a polynomial changes, in ascending order.
/// Between the roots of its derivative the polynomial is monotonic.
std::vector<double> FindSignChanges(const std::vector<double>& coefficients, double end) {
  if (coefficients.size() < 2) return {};
  std::vector<double> ends = FindSignChanges(Differentiate(coefficients), end);
  ends.push_back(end);
  std::vector<double> changes;
  double low = 0;
  for (const double high : ends) {
    if ((Evaluate(coefficients, low) > 0) != (Evaluate(coefficients, high) > 0)) {
      changes.push_back(Bisect(coefficients, low, high));
    }
    low = high;
  }
  return changes;
}

}  // namespace

Distorted Distort(const CameraParameters& p, const Eigen::Vector2d& undistorted) {
  const double r = undistorted.norm();
  const double theta = std::atan(r);
  return MoveRadially(undistorted, r, DistortAngle(p, theta), AngleSlope(p, theta) / (1 + r * r));
}

Eigen::Vector2d DistortedByCoefficient(int i, const Eigen::Vector2d& undistorted) {
  const double r = undistorted.norm();
  if (r == 0) return Eigen::Vector2d::Zero();
  const double theta = std::atan(r);
  return theta / r * std::pow(theta * theta, i) * undistorted;
}

double MaxRadius(const CameraParameters& p) {
  // The coefficients of AngleSlope as a polynomial in theta².
  const std::vector<double> slope = {1, 3 * p.k1, 5 * p.k2, 7 * p.k3, 9 * p.k4};
  const std::vector<double> turns = FindSignChanges(slope, kMaxAngle * kMaxAngle);
  return std::tan(turns.empty() ? kMaxAngle : std::sqrt(turns.front()));
}

std::optional<Eigen::Vector2d> Undistort(const CameraParameters& p, double max_radius,
                                         const Eigen::Vector2d& target) {
  const double radius = target.norm();
  if (radius == 0) return target;
  const double max_angle = std::atan(max_radius);
  if (!(radius < DistortAngle(p, max_angle))) return std::nullopt;
  const double theta =
      InvertIncreasing([&p](double angle) { return DistortAngle(p, angle); },
                       [&p](double angle) { return AngleSlope(p, angle); }, max_angle, radius);
  const double r = std::tan(theta);
  if (!(r < max_radius)) return std::nullopt;
  return Eigen::Vector2d(r / radius * target);
}

}  // namespace corvo::kannala_brandt
