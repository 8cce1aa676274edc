// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <initializer_list>
#include <iterator>

namespace corvo {

/// The angle (rad) below which the coefficients of the Jacobians are computed from their Taylor
/// series: five terms are exact to rounding there, and the closed forms lose digits to
/// cancellation.
inline constexpr double kSeriesAngle = 0.3;

/// Returns c0 + c1 x² + c2 x⁴ + ...
inline double EvenSeries(double x, std::initializer_list<double> coefficients) {
  double sum = 0;
  for (auto c = std::rbegin(coefficients); c != std::rend(coefficients); ++c)
    sum = sum * x * x + *c;
  return sum;
}

/// Returns (θ - sin θ)/θ³.
inline double AngleMinusSin(double angle) {
  if (angle > kSeriesAngle) return (angle - std::sin(angle)) / (angle * angle * angle);
  return EvenSeries(angle, {1.0 / 6, -1.0 / 120, 1.0 / 5040, -1.0 / 362880, 1.0 / 39916800});
}

}  // namespace corvo
