#pragma once

#include <vector>

#include "orb/matcher.h"
#include "vo/frame.h"

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

}  // namespace corvo
