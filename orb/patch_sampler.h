// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "orb/options.h"
#include "orb/pattern.h"
#include "orb/types.h"

namespace corvo::orb {

/// Where a test's windows may have their centers: within kMaxOffset of the keypoint, row by row.
inline constexpr int kNumPositions = (2 * kMaxOffset + 1) * (2 * kMaxOffset + 1);

/// `position` is in [0, kNumPositions).
Offset PositionAt(int position);

/// Sums over the 5x5 windows at every position.
using PositionSums = std::array<std::uint16_t, kNumPositions>;

/// Reads what descriptors are made of: window sums at positions that are rotated to the keypoint's
/// direction and rounded, as a pattern is.
class PatchSampler {
 public:
  explicit PatchSampler(const ExtractorOptions& options);

  /// Sums around every keypoint. `keypoints` are what an Extractor of the same options returns for
  /// `image`.
  std::vector<PositionSums> Sample(const cv::Mat& image, std::span<const Keypoint> keypoints) const;

 private:
  bool upright_;
  std::vector<double> octave_scales_;
  std::vector<std::array<Offset, kNumPositions>> offsets_;  ///< Of each direction.
};

}  // namespace corvo::orb
