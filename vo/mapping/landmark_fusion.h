// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vo/core/options.h"
#include "vo/map/map.h"

namespace corvo {

struct FusedLandmarks {
  int num_fused = 0;  ///< Number of merges and new observations.
  std::vector<LandmarkMerge> merges;
};

/// Fuses duplicate landmarks of a keyframe and its covisible keyframes: the landmarks of each are
/// projected into the other. If the keypoint with the nearest descriptor observes another landmark,
/// the two are merged into the one with more observations; if it observes none, it becomes an
/// observation.
FusedLandmarks FuseLandmarks(KeyframeId keyframe, const LandmarkOptions& options, int max_distance,
                             Map& map);

}  // namespace corvo
