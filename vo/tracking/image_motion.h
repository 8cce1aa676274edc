// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core/mat.hpp>

#include "vo/tracking/repeat_detector.h"
#include "vo/tracking/static_overlay.h"

namespace corvo {

/// Compares each image with earlier ones before features are extracted: does it repeat one, and
/// what has moved with the camera?
class ImageMotion {
 public:
  /// What an image is found to be.
  struct Result {
    bool is_repeat = false;
    bool has_overlay_grown = false;  ///< More of the image has to be excluded than before.
  };

  /// Takes the images in order, all of one size.
  Result Add(const cv::Mat& image);

  /// The part of the image that moves with the camera.
  const StaticOverlay& overlay() const { return overlay_; }

 private:
  RepeatDetector repeats_;
  StaticOverlay overlay_;
};

}  // namespace corvo
