#include "orb/orientation.h"

#include <algorithm>
#include <cstddef>
#include <numbers>

#include "orb/kernels/moments.h"

namespace corvo::orb {
namespace {

/// Arctangent in degrees of a slope rise / run in [0, 1], run > 0: the series of atan, turned back
/// by 45 degrees where it would converge slowly. Cut off after t^13 / 13, with |t| <= tan(22.5
/// degrees).
double SlopeDeg(double rise, double run) {
  constexpr double kTan22 = 0.41421356237309503;
  constexpr double kDegrees = 180.0 / std::numbers::pi;
  const bool steep = rise > kTan22 * run;
  const double t = (steep ? rise - run : rise) / (steep ? rise + run : run);
  const double square = t * t;
  double sum = 0.0;
  for (int k = 13; k >= 1; k -= 2) sum = 1.0 / k - square * sum;
  return (steep ? 45.0 : 0.0) + kDegrees * t * sum;
}

}  // namespace

float DirectionDeg(double x, double y) {
  if (x == 0.0 && y == 0.0) return 0.0F;
  // Turned by half a turn where y < 0, then by a quarter where x <= 0: without branches.
  const double half = y < 0.0 ? -1.0 : 1.0;
  const bool quarter = half * x <= 0.0;
  const double run = half * (quarter ? y : x);
  const double rise = half * (quarter ? -x : y);
  const double slope_deg = SlopeDeg(std::min(rise, run), std::max(rise, run));
  const double degrees = (half < 0.0 ? 180.0 : 0.0) + (quarter ? 90.0 : 0.0) +
                         (rise > run ? 90.0 - slope_deg : slope_deg);
  const auto rounded = static_cast<float>(degrees);
  return rounded < 360.0F ? rounded : 0.0F;
}

float OrientationDeg(const cv::Mat& image, int x, int y) {
  const kernels::DiscMoments moments =
      kernels::SumDiscMoments(image.ptr(y) + x, static_cast<std::ptrdiff_t>(image.step));
  return DirectionDeg(moments.x, moments.y);
}

}  // namespace corvo::orb
