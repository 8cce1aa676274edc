#pragma once

#include <vector>

#include "vo/camera/camera.h"
#include "vo/core/options.h"
#include "vo/map/keypoint_noise.h"
#include "vo/map/map.h"

namespace corvo {

struct FusedLandmarks {
  int num_fused = 0;  ///< Merges and new observations.
  std::vector<LandmarkMerge> merges;
};

/// Joins what a keyframe and its covisible keyframes know twice: each one's landmarks are projected
/// into the other; where the nearest descriptor's keypoint sees another landmark the two are
/// merged into the one with more observations, where it sees none it becomes an observation.
FusedLandmarks FuseLandmarks(Map& map, KeyframeId keyframe, const Camera& camera,
                             const KeypointNoise& noise, const KeyframeOptions& options);

}  // namespace corvo
