// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <unordered_map>

#include <opencv2/core/mat.hpp>

#include "vo/map/frame.h"

namespace corvo {

/// Returns red, green and blue at a pixel of an image of size `size`, in `image`, which shows the
/// same, 8-bit gray or BGR, and may be larger or smaller.
std::array<std::uint8_t, 3> ColorAt(const Eigen::Vector2d& pixel, const cv::Size& size,
                                    const cv::Mat& image);

/// The colors of landmarks, each from the first keyframe that observes it.
class LandmarkColors {
 public:
  /// Adds the landmarks of a keyframe that have no color. `image` is 8-bit gray or BGR, and may be
  /// larger or smaller than the processed one.
  void Add(const Frame& keyframe, const cv::Mat& image);

  /// Returns red, green and blue; a medium gray if the landmark is unknown.
  std::array<std::uint8_t, 3> Of(LandmarkId id) const;

 private:
  std::unordered_map<LandmarkId, std::array<std::uint8_t, 3>> colors_;
};

}  // namespace corvo
