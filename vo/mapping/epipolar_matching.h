// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "orb/matcher.h"
#include "vo/core/options.h"
#include "vo/map/frame.h"
#include "vo/map/measurement_model.h"

namespace corvo {

/// What a match along an epipolar line must satisfy.
struct EpipolarMatchingOptions {
  double min_depth = 0;           ///< Of the point in the first camera.
  int max_distance = 65;          ///< Bits.
  double max_ratio = 0.9;         ///< Nearest descriptor over the second nearest near the line.
  double octave_tolerance = 1.5;  ///< See LandmarkOptions.
  double parallel_sigmas = 3;     ///< See LandmarkOptions.
};

/// Matches keypoints that observe no landmark between two frames of known pose: the nearest
/// descriptor among the keypoints near the epipolar line, where a point in front of both cameras
/// would lie, at least `min_depth` in front of the first; distinct, each keypoint once, turned
/// consistently.
std::vector<orb::Match> MatchAlongEpipolarLines(const Frame& first, const Frame& second,
                                                const MeasurementModel& model,
                                                const EpipolarMatchingOptions& options);

}  // namespace corvo
