// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "orb/matcher.h"
#include "vo/lie/so3.h"
#include "vo/map/frame.h"
#include "vo/map/measurement_model.h"

namespace corvo {

/// What a match between two frames must satisfy.
struct FrameMatchingOptions {
  int max_distance = 65;   ///< Bits.
  double max_ratio = 0.8;  ///< Nearest over second nearest.
};

/// Brute-force matches of keypoints in `first` (queries) with those in `second` (train): near,
/// distinct, mutual and turned consistently.
std::vector<orb::Match> MatchFrames(const Frame& first, const Frame& second,
                                    const FrameMatchingOptions& options = {});

/// Two frames between which the camera turned, as far as is known.
struct RotatedFrames {
  const Frame& first;
  const Frame& second;
  SO3 second_from_first;
};

/// As MatchFrames, but each keypoint is searched for only where the rotation puts it: within
/// `radius_px` pixels of its octave, one octave up or down.
std::vector<orb::Match> MatchRotatedFrames(const RotatedFrames& frames,
                                           const MeasurementModel& model, double radius_px,
                                           const FrameMatchingOptions& options = {});

}  // namespace corvo
