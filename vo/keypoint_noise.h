#pragma once

#include <vector>

#include "orb/types.h"

namespace corvo {

/// Standard deviation of a keypoint's position: `sigma_px` in octave 0, and as much in pixels of
/// the level in every other.
struct KeypointNoise {
  double sigma_px = 1;
  std::vector<double> octave_scales;  ///< Size of a level's pixel in the input image.

  double Sigma(const orb::Keypoint& keypoint) const {
    return sigma_px * octave_scales[keypoint.octave];
  }
};

}  // namespace corvo
