// SPDX-License-Identifier: MIT
#include "apps/synthetic/effects.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "orb/error.h"

namespace corvo::synthetic {
namespace {

constexpr double kDarkness = 0.02;
constexpr double kDriftPeriodS = 8;
constexpr double kLongestS = 1e6;

}  // namespace

void CheckSpan(const std::string& name, const TimeSpan& span) {
  CheckRange(name + " start", span.start_s, 0.0, kLongestS);
  CheckRange(name + " duration", span.duration_s, 0.0, kLongestS);
}

void Effects::Validate() const {
  CheckSpan("dark", dark);
  CheckSpan("blur", blur);
  CheckRange("exposure_drift", exposure_drift, 0.0, 3.0);
  CheckRange("vignetting", vignetting, 0.0, 0.95);
  CheckRange("moving_share", moving_share, 0.0, 0.8);
}

double Brightness(const Effects& effects, double seconds) {
  const double stops =
      effects.exposure_drift * std::sin(2 * std::numbers::pi * seconds / kDriftPeriodS);
  return (effects.dark.Contains(seconds) ? kDarkness : 1.0) * std::exp2(stops);
}

void ApplyLight(cv::Mat* image, const Effects& effects, double seconds) {
  const double brightness = Brightness(effects, seconds);
  if (brightness == 1 && effects.vignetting == 0) return;
  const double middle_x = 0.5 * (image->cols - 1), middle_y = 0.5 * (image->rows - 1);
  const double corner = middle_x * middle_x + middle_y * middle_y;
  for (int y = 0; y < image->rows; ++y) {
    std::uint8_t* row = image->ptr<std::uint8_t>(y);
    for (int x = 0; x < image->cols; ++x) {
      const double dx = x - middle_x, dy = y - middle_y;
      const double lens = 1 - effects.vignetting * (dx * dx + dy * dy) / corner;
      row[x] = static_cast<std::uint8_t>(std::min(255.0, brightness * lens * row[x] + 0.5));
    }
  }
}

}  // namespace corvo::synthetic
