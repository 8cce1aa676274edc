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

/// Keypoints detected in both of two views. Keypoints of the same index correspond.
struct KeypointPairs {
  std::vector<orb::Keypoint> first;
  std::vector<orb::Keypoint> second;
};

/// Returns, for each keypoint of `first`, the corresponding keypoint of `second`: the nearest to
/// the pixel predicted by the homography within 2 px of its own pyramid level, at most one level
/// coarser or finer than the level predicted from the homography's local scale. Keypoints without a
/// correspondence are omitted.
KeypointPairs FindAgain(std::span<const orb::Keypoint> first, std::span<const orb::Keypoint> second,
                        const cv::Matx33d& second_from_first,
                        std::span<const double> octave_scales);

/// The window sums around keypoints in both of two views. Entries of the same index correspond.
struct TrainingPairs {
  std::vector<orb::PositionSums> first;
  std::vector<orb::PositionSums> second;
};

/// Makes training pairs from images: the inputs of the binary tests of a keypoint in the image and
/// in a MakeTrainingView() of it, where the keypoint is detected again with its detection error.
class TrainingPairSampler {
 public:
  explicit TrainingPairSampler(const orb::ExtractorOptions& options);

  /// Samples the pairs of an 8-bit image with one channel. Thread-safe.
  TrainingPairs Sample(const cv::Mat& image, std::uint64_t seed) const;

 private:
  orb::Extractor extractor_;
  orb::PatchSampler sampler_;
};

}  // namespace corvo
