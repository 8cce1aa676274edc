// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>

#include "vo/core/frame_result.h"

namespace corvo {

/// The path of the camera so far, drawn from above into the corner of an image.
class PathInset {
 public:
  /// Adds the position of a posed frame. The path begins anew with a segment.
  void Add(const FrameResult& frame);

  /// Draws the path into the upper right corner of a color image: x to the right and z upwards in
  /// the world of the first camera. Draws nothing for fewer than two positions.
  void Draw(cv::Mat& image) const;

 private:
  int segment_ = kNoId;
  std::vector<Eigen::Vector2d> path_;  ///< x and z.
};

}  // namespace corvo
