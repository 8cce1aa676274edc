// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vo/core/options.h"
#include "vo/map/map.h"

namespace corvo {

struct FusedLandmarks {
  int num_fused = 0;  ///< Merges and new observations.
  std::vector<LandmarkMerge> merges;
};

/// Fuses what a keyframe and its covisible keyframes have twice: the landmarks of each are
/// projected into the other. Where the keypoint with the nearest descriptor observes another
/// landmark, the two are merged into the one with more observations; where it observes none, it
/// becomes an observation.
FusedLandmarks FuseLandmarks(KeyframeId keyframe, const LandmarkOptions& options, int max_distance,
                             Map& map);

}  // namespace corvo
