// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <opencv2/features2d.hpp>

#include "bench/quality/measures.h"

namespace corvo::bench {

/// A feature extractor under comparison.
struct Contender {
  std::string name;
  cv::Ptr<cv::Feature2D> features;
};

/// Returns corvo with a grid (the default), with the strongest keypoints of the whole image (Harris
/// response, 256 directions), and with a grid but upright; then cv::ORB, cv::SIFT, cv::BRISK and
/// cv::AKAZE with their own defaults.
std::vector<Contender> MakeContenders(int num_features);

/// Returns the `num_features` keypoints of highest response; ties go to the first. Octaves are
/// integers from 0, or -1 for cv::SIFT's doubled image.
DescribedPoints Describe(const Contender& contender, const cv::Mat& image, int num_features);

}  // namespace corvo::bench
