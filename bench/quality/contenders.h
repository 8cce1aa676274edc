// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <opencv2/features2d.hpp>

#include "bench/quality/measures.h"

namespace corvo::bench {

/// Features under comparison.
struct Contender {
  std::string name;
  cv::Ptr<cv::Feature2D> features;
};

/// corvo with a grid (the default), the strongest anywhere (Harris response, 256 directions), and
/// with a grid but upright; then cv::ORB, cv::SIFT, cv::BRISK and cv::AKAZE with their own
/// defaults.
std::vector<Contender> MakeContenders(int num_features);

/// The `num_features` keypoints of highest response; between equals the first. Octaves are whole
/// numbers from 0, or -1 for cv::SIFT's doubled image.
DescribedPoints Describe(const Contender& contender, const cv::Mat& image, int num_features);

}  // namespace corvo::bench
