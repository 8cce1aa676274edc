#pragma once

#include "vo/camera/camera.h"
#include "vo/core/options.h"
#include "vo/map/keypoint_noise.h"
#include "vo/map/map.h"

namespace corvo {

/// Matches keypoints that see nothing yet between a keyframe and its covisible keyframes along
/// epipolar lines, triangulates them and adds the points that lie in front of both, with enough
/// parallax, a small reprojection error in both and octaves that agree with the distances. Returns
/// the number of new landmarks.
int CreateLandmarks(Map& map, KeyframeId keyframe, const Camera& camera, const KeypointNoise& noise,
                    const KeyframeOptions& options);

}  // namespace corvo
