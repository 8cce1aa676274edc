#pragma once

#include <vector>

#include "orb/matcher.h"
#include "vo/camera/camera.h"
#include "vo/lie/so3.h"
#include "vo/map/frame.h"

namespace corvo {

/// What a match between two frames must satisfy.
struct FrameMatchingOptions {
  int max_distance = 64;   ///< Bits.
  double max_ratio = 0.8;  ///< Nearest over second nearest.
};

/// Brute-force matches of keypoints in `first` (queries) with those in `second` (train): near,
/// distinct, mutual and turned consistently.
std::vector<orb::Match> MatchFrames(const Frame& first, const Frame& second,
                                    const FrameMatchingOptions& options = {});

/// As MatchFrames, but each keypoint is looked for only where the rotation between the views puts
/// it: within `radius_px` times the scale of its octave, one octave up or down.
std::vector<orb::Match> MatchRotatedFrames(const Frame& first, const Frame& second,
                                           const SO3& second_from_first, const Camera& camera,
                                           const std::vector<double>& octave_scales,
                                           double radius_px,
                                           const FrameMatchingOptions& options = {});

}  // namespace corvo
