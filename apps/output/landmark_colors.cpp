// SPDX-License-Identifier: MIT
#include "apps/output/landmark_colors.h"

#include <algorithm>
#include <cmath>

namespace corvo {
namespace {

/// Returns the pixel of a resized image that shows what `pixel` shows, along one axis.
int Rescale(double pixel, int size, int new_size) {
  const double scaled = (pixel + 0.5) * new_size / size;
  return std::clamp(static_cast<int>(std::floor(scaled)), 0, new_size - 1);
}

}  // namespace

std::array<std::uint8_t, 3> ColorAt(const Eigen::Vector2d& pixel, const cv::Size& size,
                                    const cv::Mat& image) {
  const cv::Point at(Rescale(pixel.x(), size.width, image.cols),
                     Rescale(pixel.y(), size.height, image.rows));
  if (image.channels() == 1) {
    const std::uint8_t gray = image.at<std::uint8_t>(at);
    return {gray, gray, gray};
  }
  const auto& bgr = image.at<cv::Vec3b>(at);
  return {bgr[2], bgr[1], bgr[0]};
}

void LandmarkColors::Add(const Frame& keyframe, const cv::Mat& image) {
  const cv::Size size(keyframe.camera.width, keyframe.camera.height);
  for (int k = 0; k < keyframe.num_keypoints(); ++k) {
    const LandmarkId id = keyframe.landmarks[k];
    if (id == kNoId || colors_.count(id) > 0) continue;
    colors_[id] = ColorAt(keyframe.pixel(k), size, image);
  }
}

std::array<std::uint8_t, 3> LandmarkColors::Of(LandmarkId id) const {
  const auto found = colors_.find(id);
  return found == colors_.end() ? std::array<std::uint8_t, 3>{128, 128, 128} : found->second;
}

}  // namespace corvo
