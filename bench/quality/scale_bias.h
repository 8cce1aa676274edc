// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <opencv2/core/types.hpp>

namespace corvo::bench {

/// The mean position error of the keypoints of an octave.
struct OctaveBias {
  int octave = 0;
  int pairs = 0;
  cv::Point2d px;  ///< Mean error in pixels of the image.
};

/// Measures the bias from the keypoints of an image and of its copy rotated by 180 degrees, which
/// needs no interpolation: the keypoint at x reappears at (width - 1, height - 1) - x, except for a
/// constant error, which shifts both in the same direction. Pairs are formed within an octave, the
/// nearest first, with each point in at most one pair and at most `reach_px` apart.
std::vector<OctaveBias> MeasureBias(const std::vector<cv::KeyPoint>& points,
                                    const std::vector<cv::KeyPoint>& turned, cv::Size size,
                                    double reach_px);

/// Returns one bias for each octave, ascending: the mean over all pairs of the given ones.
std::vector<OctaveBias> MergeOctaves(const std::vector<OctaveBias>& biases);

}  // namespace corvo::bench
