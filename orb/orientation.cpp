#include "orb/orientation.h"

#include <cstddef>
#include <numbers>

#include "orb/kernels/moments.h"

namespace corvo::orb {
namespace {

/// Arctangent in degrees of a slope in [0, 1]: the series of atan, moved by 45 degrees where it
/// would converge slowly.
double SlopeDeg(double slope) {
  constexpr double kTan22 = 0.41421356237309503;
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  const bool steep = slope > kTan22;
  const double t = steep ? (slope - 1.0) / (slope + 1.0) : slope;
  const double square = t * t;
  double sum = 0.0;
  for (int k = 19; k >= 1; k -= 2) sum = 1.0 / k - square * sum;
  return (steep ? 45.0 : 0.0) + kDegrees * t * sum;
}

/// Direction in [0, 90] of a vector with neither component negative and not both zero.
double QuadrantDeg(double x, double y) { return y <= x ? SlopeDeg(y / x) : 90.0 - SlopeDeg(x / y); }

}  // namespace

float DirectionDeg(double x, double y) {
  if (x == 0.0 && y == 0.0) return 0.0F;
  double degrees = 0.0;
  if (y >= 0.0) {
    degrees = x > 0.0 ? QuadrantDeg(x, y) : 90.0 + QuadrantDeg(y, -x);
  } else {
    degrees = x < 0.0 ? 180.0 + QuadrantDeg(-x, -y) : 270.0 + QuadrantDeg(-y, x);
  }
  const auto rounded = static_cast<float>(degrees);
  return rounded < 360.0F ? rounded : 0.0F;
}

float OrientationDeg(const cv::Mat& image, int x, int y) {
  const kernels::DiscMoments moments =
      kernels::SumDiscMoments(image.ptr(y) + x, static_cast<std::ptrdiff_t>(image.step));
  return DirectionDeg(moments.x, moments.y);
}

}  // namespace corvo::orb
