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

/// Returns the area of a level that may contain keypoints.
cv::Rect InsideBorder(const cv::Mat& level_image);

/// The output of Describe(): as many keypoints as descriptors.
struct FeatureSpan {
  std::span<Keypoint> keypoints;
  std::span<Descriptor> descriptors;
};

/// Extracts the features of one level, from one image after another. Keeps its buffers; not
/// thread-safe.
class LevelExtractor {
 public:
  /// Finds the level's corners inside border and mask. `mask` is empty or of the size of the input
  /// image.
  void Detect(const PyramidLevel& level, const cv::Mat& mask, const ExtractorOptions& options);

  int num_corners() const { return static_cast<int>(corners_.size()); }

  /// Selects features.keypoints.size() corners, at most num_corners(), and sets their keypoints and
  /// descriptors, in row-major order. `level` is the level passed to Detect().
  void Describe(const PyramidLevel& level, int octave, const ExtractorOptions& options,
                const Describer& describer, FeatureSpan features);

 private:
  /// Chooses the corners of highest rank anywhere in the level. Harris responses rank only the 2 *
  /// `quota` corners of highest FAST score, so that a chosen corner has high contrast and a large
  /// response.
  void SelectAnywhere(const cv::Mat& image, int quota, const ExtractorOptions& options);
  /// Computes the directions of the chosen corners.
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
