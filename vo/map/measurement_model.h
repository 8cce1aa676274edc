// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vo/camera/camera.h"
#include "vo/core/options.h"
#include "vo/map/frame.h"
#include "vo/map/observation.h"

namespace corvo {

/// How images measure points: the camera projects them, and keypoints are found near the
/// projections, with a standard deviation that grows with the size of their octave's pixels.
struct MeasurementModel {
  Camera camera;
  MeasurementOptions options;
  std::vector<double> octave_scales;  ///< Size of an octave's pixel, px of the input image.

  /// Size of a pixel of the octave in which keypoint `k` of a frame was found, px of the input
  /// image.
  double Scale(const Frame& frame, int k) const { return octave_scales[frame.keypoint(k).octave]; }

  /// Standard deviation of keypoint `k` of a frame along each axis, px of the input image.
  double Sigma(const Frame& frame, int k) const {
    return (frame.is_aligned[k] ? options.aligned_sigma_px : options.keypoint_sigma_px) *
           Scale(frame, k);
  }
};

/// What keypoint `k` of a frame observes.
inline Observation Observe(const Frame& frame, int k, const MeasurementModel& model) {
  return {frame.landmarks[k], k, frame.pixel(k), model.Sigma(frame, k)};
}

}  // namespace corvo
