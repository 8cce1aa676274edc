// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <opencv2/core/mat.hpp>

namespace corvo::synthetic {

/// A half-open interval of a sequence's time: the start is included, the end is not.
struct TimeSpan {
  double start_s = 0;
  double duration_s = 0;

  bool Contains(double seconds) const {
    return seconds >= start_s && seconds < start_s + duration_s;
  }
};

/// Throws corvo::Error with the name of the field if the start or the duration of `name` is out of
/// range.
void CheckSpan(const std::string& name, const TimeSpan& span);

/// Disturbances of the images of a sequence. They do not affect the ground truth.
struct Effects {
  TimeSpan dark;  ///< Near darkness: grays are divided by 50.
  TimeSpan blur;  ///< Motion blur: the shutter is open for a frame interval, centered on the frame.
  double exposure_drift = 0;  ///< Amplitude of an exposure oscillation (8 s period), stops; 0 to 3.
  double vignetting = 0;      ///< Fraction of the light that is lost in the corners; 0 to 0.95.
  double moving_share = 0;    ///< Fraction of the image covered by moving objects; 0 to 0.8.

  /// Throws corvo::Error with the name of the first field that is out of range.
  void Validate() const;
};

/// Returns the brightness of a frame relative to the scene; 1 without `dark` and `exposure_drift`.
double Brightness(const Effects& effects, double seconds);

/// Applies darkness, exposure drift and vignetting at the given time to an 8-bit gray image.
void ApplyLight(cv::Mat* image, const Effects& effects, double seconds);

}  // namespace corvo::synthetic
