// SPDX-License-Identifier: MIT
#pragma once

#include "vo/core/options.h"
#include "vo/map/map.h"

namespace corvo {

/// Matches keypoints that observe no landmark between a keyframe and its covisible keyframes along
/// epipolar lines, triangulates them and adds the points that lie in front of both cameras, with
/// enough parallax, a small reprojection error in both images and octaves consistent with the
/// distances. Where more than 30% of the keyframe's keypoints lie on straight edges, along which a
/// match may slide (orb::EigenvalueShare), these give none. Returns the number of new landmarks.
int CreateLandmarks(KeyframeId keyframe, const LandmarkOptions& options, int max_distance,
                    Map& map);

}  // namespace corvo
