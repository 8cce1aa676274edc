// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <opencv2/core/types.hpp>

namespace corvo::bench {

/// How far the keypoints of an octave lie from where they should, on average.
struct OctaveBias {
  int octave = 0;
  int pairs = 0;
  cv::Point2d px;  ///< Of the image.
};

/// From the keypoints of an image and of the same turned by half, which interpolates nothing: what
/// lies at x is found again at (width - 1, height - 1) - x, but for a constant error, which moves
/// both the same way. Pairs are of one octave, the nearest first, each point in one, and at most
/// `reach_px` apart.
std::vector<OctaveBias> MeasureBias(const std::vector<cv::KeyPoint>& points,
                                    const std::vector<cv::KeyPoint>& turned, cv::Size size,
                                    double reach_px);

/// One for each octave, ascending: means over all pairs of those given.
std::vector<OctaveBias> MergeOctaves(const std::vector<OctaveBias>& biases);

}  // namespace corvo::bench
