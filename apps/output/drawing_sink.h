// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core/mat.hpp>

#include "vo/core/frame_result.h"

namespace corvo {

/// The files to which the drawings of a run go.
class DrawingSink {
 public:
  virtual ~DrawingSink() = default;

  /// Adds the drawing of the next frame. Throws corvo::Error if it cannot be written.
  virtual void Add(const cv::Mat& drawing, const FrameResult& frame) = 0;
  /// Ends the drawings of a run, which processed all images or not. Throws corvo::Error if they
  /// cannot be written in full.
  virtual void Finish(bool is_complete) = 0;
};

}  // namespace corvo
