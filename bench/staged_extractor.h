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

/// Processor time of each stage, ms.
using StageTimes = std::array<double, kStages.size()>;

/// What orb::Extractor does on one thread with its default options, one stage after the other.
/// Descriptors are made while their level is smoothed: here it is smoothed before without them,
/// twice to find it in the cache like them, and their time is the rest.
class StagedExtractor {
 public:
  explicit StagedExtractor(int num_features);

  /// Sets features() to the image's. Returns the time of each stage, over all levels.
  StageTimes Extract(const cv::Mat& image);

  /// By level.
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
  std::vector<std::vector<orb::Corner>> corners_;  ///< By level.
  std::vector<std::vector<int>> chosen_;           ///< By level: indices of corners.
  std::vector<orb::Features> features_;
};

}  // namespace corvo::bench
