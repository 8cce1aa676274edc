// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "orb/descriptor.h"
#include "orb/fast.h"
#include "orb/grid.h"
#include "orb/kernels/moments.h"
#include "orb/options.h"
#include "orb/pyramid.h"
#include "orb/types.h"
#include "orb/window_sums.h"

namespace corvo::orb {

/// Where a level may have keypoints.
cv::Rect InsideBorder(const cv::Mat& level_image);

/// Room for features: as many keypoints as descriptors.
struct FeatureSpan {
  std::span<Keypoint> keypoints;
  std::span<Descriptor> descriptors;
};

/// The features of one level of one image after another; keeps its buffers.
class LevelExtractor {
 public:
  /// Finds the level's corners inside border and mask. `mask` is empty or of the input's size.
  void Detect(const PyramidLevel& level, const cv::Mat& mask, const ExtractorOptions& options);

  int num_corners() const { return static_cast<int>(corners_.size()); }

  /// Selects as many corners as there is room for, no more than num_corners(), and sets their
  /// keypoints and descriptors, in row-major order. `level` is the one they were found in.
  void Describe(const PyramidLevel& level, int octave, const ExtractorOptions& options,
                const Describer& describer, FeatureSpan features);

 private:
  /// Chooses the corners of highest rank wherever they are. Of Harris responses only those of the
  /// corners with the highest scores count, two for each that is wanted: a corner has to be sharp
  /// and large.
  void SelectAnywhere(const cv::Mat& image, int quota, const ExtractorOptions& options);
  /// Sets the directions of the chosen corners.
  void Orient(const cv::Mat& image);

  FastDetector detector_;
  std::vector<Corner> corners_;
  GridSelector selector_;
  std::vector<int> chosen_;
  std::vector<kernels::DiscMoments> moments_;
  std::vector<float> angles_deg_;
  WindowSumBand sums_;
};

}  // namespace corvo::orb
