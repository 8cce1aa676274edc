// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "orb/matcher.h"
#include "vo/lie/so3.h"
#include "vo/map/frame.h"
#include "vo/map/measurement_model.h"

namespace corvo {

/// The requirements for a match between two frames.
struct FrameMatchingOptions {
  int max_distance = 65;   ///< Largest descriptor distance, bits.
  double max_ratio = 0.8;  ///< Largest ratio of nearest to second nearest distance.
};

/// Returns the brute-force matches of keypoints in `first` (queries) with those in `second` (train)
/// that pass the distance test, the ratio test and the cross check and agree on the rotation
/// between the images.
std::vector<orb::Match> MatchFrames(const Frame& first, const Frame& second,
                                    const FrameMatchingOptions& options = {});

/// Two frames between which the camera, as far as is known, only rotated.
struct RotatedFrames {
  const Frame& first;
  const Frame& second;
  SO3 second_from_first;
};

/// Like MatchFrames(), but guided by the rotation: each keypoint is searched for only within
/// `radius_px` pixels of its octave around its predicted position, in octaves up to one away.
std::vector<orb::Match> MatchRotatedFrames(const RotatedFrames& frames,
                                           const MeasurementModel& model, double radius_px,
                                           const FrameMatchingOptions& options = {});

}  // namespace corvo
