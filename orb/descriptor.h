#pragma once

#include <opencv2/core/mat.hpp>

#include "orb/pattern.h"
#include "orb/types.h"

namespace corvo::orb {

/// Distance from a level's edge within which there are no keypoints: holds the windows of a
/// pattern in any direction (13 sqrt(2), rounded up, plus 2).
inline constexpr int kBorder = 21;

/// Sums over the 5x5 window centred at each pixel, 16-bit, one channel; the outer 2 px are 0.
/// `image` is 8-bit, one channel.
cv::Mat WindowSums(const cv::Mat& image);

/// Descriptor of the keypoint at (x, y), at least kBorder px from the edges of `sums`: bit i is 1
/// iff the sum at p of test i is less than the sum at q. Sums are exact and only compared, so a
/// gain and an offset of the image that saturate nothing leave every bit as it is.
Descriptor Describe(const cv::Mat& sums, int x, int y, const Pattern& pattern);

}  // namespace corvo::orb
