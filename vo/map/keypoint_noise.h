#pragma once

#include <vector>

#include "vo/map/frame.h"

namespace corvo {

/// Standard deviation of a keypoint's position, in pixels of its level: the same in every octave.
struct KeypointNoise {
  double sigma_px = 1;                ///< Where it was detected.
  double aligned_sigma_px = 0.6;      ///< Where its patch was aligned with a landmark's.
  std::vector<double> octave_scales;  ///< Size of a level's pixel in the input image.

  /// Of keypoint `k` of a frame, px of the input image.
  double Sigma(const Frame& frame, int k) const {
    return (frame.is_aligned[k] ? aligned_sigma_px : sigma_px) *
           octave_scales[frame.keypoint(k).octave];
  }
};

}  // namespace corvo
