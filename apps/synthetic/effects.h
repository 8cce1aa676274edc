// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <opencv2/core/mat.hpp>

namespace corvo::synthetic {

/// A stretch of a sequence's time, from its start up to but not including its end.
struct TimeSpan {
  double start_s = 0;
  double duration_s = 0;

  bool Contains(double seconds) const {
    return seconds >= start_s && seconds < start_s + duration_s;
  }
};

/// Throws corvo::Error naming the start or the duration of `name` if it is out of range.
void CheckSpan(const std::string& name, const TimeSpan& span);

/// What goes wrong with the images of a sequence. The truth stays as it is.
struct Effects {
  TimeSpan dark;  ///< The light is all but out: grays fall to a fiftieth.
  TimeSpan blur;  ///< The shutter stays open from the middle before a frame to the middle after it.
  double exposure_drift = 0;  ///< Brightness swings by this many stops either way, in 8 s; 0 to 3.
  double vignetting = 0;      ///< Share of the light that the corners lose; 0 to 0.95.
  double moving_share = 0;    ///< Share of the image hidden by things that move; 0 to 0.8.

  /// Throws corvo::Error naming the first field out of range.
  void Validate() const;
};

/// How much brighter a frame is than the scene; 1 without dark and drift.
double Brightness(const Effects& effects, double seconds);

/// Darkens, brightens and vignettes an image (8-bit gray) of that time as `effects` say.
void ApplyLight(cv::Mat* image, const Effects& effects, double seconds);

}  // namespace corvo::synthetic
