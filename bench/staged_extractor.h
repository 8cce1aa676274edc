// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "orb/descriptor.h"
#include "orb/extractor.h"
#include "orb/fast.h"
#include "orb/grid.h"
#include "orb/pyramid.h"
#include "orb/types.h"
#include "orb/window_sums.h"
#include "orb/workers.h"

namespace corvo::bench {

/// The stages of extraction, in order.
inline constexpr std::array<const char*, 6> kStages = {"pyramid",     "FAST",      "selection",
                                                       "orientation", "smoothing", "descriptors"};

/// The processor time of each stage, ms.
using StageTimes = std::array<double, kStages.size()>;

/// Runs the stages of orb::Extractor one after the other, on one thread and with default options.
/// Descriptors are computed while their level is smoothed. Smoothing alone is therefore timed
/// before, in the second of two passes so that the level is in the cache, and subtracted.
class StagedExtractor {
 public:
  explicit StagedExtractor(int num_features);

  /// Sets features() to those of the image. Returns the time of each stage, summed over all levels.
  StageTimes Extract(const cv::Mat& image);

  /// Returns the features of each level.
  const std::vector<orb::Features>& features() const { return features_; }

 private:
  void Detect();
  void Select();
  void Orient();
  void Smooth();
  void Describe();

  orb::ExtractorOptions options_;
  orb::Workers workers_{1};
  orb::Pyramid pyramid_;
  std::vector<orb::FastDetector> detectors_;
  std::vector<orb::GridSelector> selectors_;
  orb::WindowSumBand sums_;
  orb::Describer describer_;
  std::vector<std::int64_t> areas_;
  std::vector<int> num_corners_;
  std::vector<int> quotas_;
  std::vector<std::vector<orb::Corner>> corners_;  ///< Corners, by level.
  std::vector<std::vector<int>> chosen_;           ///< Indices of corners, by level.
  std::vector<orb::Features> features_;
};

}  // namespace corvo::bench
