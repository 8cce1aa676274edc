// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "orb/matcher.h"
#include "vo/core/options.h"
#include "vo/map/frame.h"
#include "vo/map/measurement_model.h"

namespace corvo {

/// The requirements for a match along an epipolar line.
struct EpipolarMatchingOptions {
  double min_depth = 0;    ///< Least depth of the point in the first camera.
  int max_distance = 65;   ///< Largest descriptor distance, bits.
  double max_ratio = 0.9;  ///< Largest ratio of nearest to second nearest distance near the line.
  double octave_tolerance = 1.5;  ///< See LandmarkOptions.
  double parallel_sigmas = 3;     ///< See LandmarkOptions.
};

/// Matches keypoints that observe no landmark between two frames with known poses. Each is matched
/// with the nearest descriptor among the keypoints near its epipolar line, where a point in front
/// of both cameras and at least `min_depth` in front of the first would lie. Matches pass the ratio
/// test, use each keypoint at most once and agree on the rotation between the images.
std::vector<orb::Match> MatchAlongEpipolarLines(const Frame& first, const Frame& second,
                                                const MeasurementModel& model,
                                                const EpipolarMatchingOptions& options);

}  // namespace corvo
