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

/// The number of possible centers of a test's windows: the pixels within kMaxOffset of the
/// keypoint, row by row.
inline constexpr int kNumPositions = (2 * kMaxOffset + 1) * (2 * kMaxOffset + 1);

/// Returns the offset of a position, which is in [0, kNumPositions).
Offset PositionAt(int position);

/// The sums over the 5x5 windows at every position.
using PositionSums = std::array<std::uint16_t, kNumPositions>;

/// Samples the data from which descriptors are computed: window sums at positions that are rotated
/// to the keypoint's direction and rounded, like the tests of a pattern.
class PatchSampler {
 public:
  explicit PatchSampler(const ExtractorOptions& options);

  /// Returns the window sums around every keypoint. `keypoints` are the result of an Extractor with
  /// the same options on `image`.
  std::vector<PositionSums> Sample(const cv::Mat& image, std::span<const Keypoint> keypoints) const;

 private:
  bool upright_;
  std::vector<double> octave_scales_;
  std::vector<std::array<Offset, kNumPositions>> offsets_;  ///< By direction.
};

}  // namespace corvo::orb
