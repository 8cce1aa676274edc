// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vo/camera/camera.h"
#include "vo/core/options.h"
#include "vo/map/frame.h"
#include "vo/map/observation.h"

namespace corvo {

/// A model of image measurements: the camera projects points, and keypoints are detected near the
/// projections, with a standard deviation proportional to the pixel size of their octave.
struct MeasurementModel {
  Camera camera;
  MeasurementOptions options;
  std::vector<double> octave_scales;  ///< Pixel size of each octave, px of the input image.

  /// Returns the pixel size of the octave in which keypoint `k` of a frame was detected, px of the
  /// input image.
  double Scale(const Frame& frame, int k) const { return octave_scales[frame.keypoint(k).octave]; }

  /// Returns the standard deviation of keypoint `k` of a frame along each axis, px of the input
  /// image.
  double Sigma(const Frame& frame, int k) const {
    return (frame.is_aligned[k] ? options.aligned_sigma_px : options.keypoint_sigma_px) *
           Scale(frame, k);
  }
};

/// Returns the observation of keypoint `k` of a frame.
inline Observation Observe(const Frame& frame, int k, const MeasurementModel& model) {
  return {frame.landmarks[k], k, frame.pixel(k), model.Sigma(frame, k)};
}

}  // namespace corvo
