#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>

#include "orb/kernels/patch.h"
#include "orb/pattern.h"
#include "orb/types.h"

namespace corvo::orb {

/// Distance from a level's edge within which there are no keypoints: holds the windows of a
/// pattern in any direction (13 sqrt(2), rounded up, plus 2).
inline constexpr int kBorder = 21;

/// Sums over the 5x5 window centred at each pixel, 16-bit, one channel; the outer 2 px are 0.
/// `image` is 8-bit, one channel.
cv::Mat WindowSums(const cv::Mat& image);

/// Describes keypoints by one pattern, rotated to their direction.
class Describer {
 public:
  /// `bins` directions, 1 to 256; `upright`: the pattern is not rotated.
  Describer(const Pattern& pattern, int bins, bool upright);

  /// Descriptor of the keypoint at (x, y), at least kBorder px from the edges of `image` (8-bit,
  /// one channel), in the direction nearest to `angle_deg`, which is in [0, 360): bit i is 1 iff
  /// the sum over the 5x5 window at p of test i is less than that at q. Sums are exact and only
  /// compared, so a gain and an offset of the image that saturate nothing leave every bit as it is.
  Descriptor Describe(const cv::Mat& image, int x, int y, float angle_deg) const;

 private:
  RotatedPatterns patterns_;
  bool upright_;
  std::vector<kernels::PatchTests> tests_;  ///< Of each direction.
};

}  // namespace corvo::orb
