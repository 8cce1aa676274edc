// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <opencv2/core/mat.hpp>
#include <opencv2/core/matx.hpp>

#include "orb/extractor.h"
#include "orb/patch_sampler.h"

namespace corvo {

/// Keypoints detected in both of two views, index by index.
struct KeypointPairs {
  std::vector<orb::Keypoint> first;
  std::vector<orb::Keypoint> second;
};

/// Of every keypoint the one that was detected where a homography takes it: the nearest within 2 px
/// of its own level, at most a level coarser or finer than the homography's scale there makes it.
/// Keypoints without one are left out.
KeypointPairs FindAgain(std::span<const orb::Keypoint> first, std::span<const orb::Keypoint> second,
                        const cv::Matx33d& second_from_first,
                        std::span<const double> octave_scales);

/// The sums around keypoints in both of two views, index by index.
struct TrainingPairs {
  std::vector<orb::PositionSums> first;
  std::vector<orb::PositionSums> second;
};

/// Makes training pairs of images: what a keypoint's tests see in the image and again, with all
/// the error of its detection, in a MakeTrainingView().
class TrainingPairSampler {
 public:
  explicit TrainingPairSampler(const orb::ExtractorOptions& options);

  /// `image` is 8-bit, one channel. Several threads may call it at once.
  TrainingPairs Sample(const cv::Mat& image, std::uint64_t seed) const;

 private:
  orb::Extractor extractor_;
  orb::PatchSampler sampler_;
};

}  // namespace corvo
