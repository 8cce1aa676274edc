// SPDX-License-Identifier: MIT
#include "apps/output/landmark_colors.h"

#include <algorithm>
#include <cmath>

namespace corvo {
namespace {

std::array<std::uint8_t, 3> ColorAt(const cv::Mat& image, int x, int y) {
  if (image.channels() == 1) {
    const std::uint8_t gray = image.at<std::uint8_t>(y, x);
    return {gray, gray, gray};
  }
  const auto& bgr = image.at<cv::Vec3b>(y, x);
  return {bgr[2], bgr[1], bgr[0]};
}

/// Returns the pixel of a resized image that shows what `pixel` shows, along one axis.
int Rescale(double pixel, int size, int new_size) {
  const double scaled = (pixel + 0.5) * new_size / size;
  return std::clamp(static_cast<int>(std::floor(scaled)), 0, new_size - 1);
}

}  // namespace

void LandmarkColors::Add(const Frame& keyframe, const cv::Mat& image) {
  for (int k = 0; k < keyframe.num_keypoints(); ++k) {
    const LandmarkId id = keyframe.landmarks[k];
    if (id == kNoId || colors_.count(id) > 0) continue;
    const Eigen::Vector2d& pixel = keyframe.pixel(k);
    colors_[id] = ColorAt(image, Rescale(pixel.x(), keyframe.camera.width, image.cols),
                          Rescale(pixel.y(), keyframe.camera.height, image.rows));
  }
}

std::array<std::uint8_t, 3> LandmarkColors::Of(LandmarkId id) const {
  const auto found = colors_.find(id);
  return found == colors_.end() ? std::array<std::uint8_t, 3>{128, 128, 128} : found->second;
}

}  // namespace corvo
