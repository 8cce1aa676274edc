// SPDX-License-Identifier: MIT
#pragma once

#include <opencv2/core/mat.hpp>

#include "apps/export/reconstruction.h"
#include "vo/camera/camera.h"

namespace corvo {

/// Removes the distortion of images, and that of what was measured in them: afterwards a camera
/// without distortion has the same size, focal lengths and principal point.
class Undistortion {
 public:
  explicit Undistortion(const Camera& camera);

  const Camera& undistorted_camera() const { return undistorted_; }

  /// Returns the undistorted image, interpolated linearly; black where the camera saw nothing.
  /// `image` has the size of the camera and any number of channels.
  cv::Mat Apply(const cv::Mat& image) const;

  /// Replaces the camera and moves the observations; those without a ray are removed.
  void Apply(Reconstruction& reconstruction) const;

 private:
  Camera distorted_, undistorted_;
  cv::Mat map_;  // Position in the distorted image of each pixel, CV_32FC2.
};

}  // namespace corvo
