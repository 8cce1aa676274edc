#pragma once

#include <vector>

#include <opencv2/core/mat.hpp>

#include "orb/descriptor.h"
#include "orb/fast.h"
#include "orb/grid.h"
#include "orb/options.h"
#include "orb/pyramid.h"
#include "orb/types.h"
#include "orb/window_sums.h"

namespace corvo::orb {

/// Where a level may have keypoints.
cv::Rect InsideBorder(const cv::Mat& level_image);

/// The features of one level of one image after another; keeps its buffers.
class LevelExtractor {
 public:
  /// Finds the level's corners inside border and mask. `mask` is empty or of the input's size.
  void Detect(const PyramidLevel& level, const cv::Mat& mask, const ExtractorOptions& options);

  int num_corners() const { return static_cast<int>(corners_.size()); }

  /// Makes features of at most `quota` of the corners, in row-major order. `level` is the one they
  /// were found in.
  void Describe(const PyramidLevel& level, int octave, int quota, const ExtractorOptions& options,
                const Describer& describer);

  const Features& features() const { return features_; }

 private:
  FastDetector detector_;
  std::vector<Corner> corners_;
  GridSelector selector_;
  std::vector<int> chosen_;
  WindowSumBand sums_;
  Features features_;
};

}  // namespace corvo::orb
