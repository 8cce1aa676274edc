#pragma once

#include <vector>

#include "orb/matcher.h"
#include "vo/camera/camera.h"
#include "vo/map/frame.h"
#include "vo/map/keypoint_noise.h"

namespace corvo {

/// Matches of keypoints that see no landmark between two frames of known pose: the nearest
/// descriptor within `max_distance` bits among the keypoints near the epipolar line, where a point
/// at least `min_depth` before the first camera would lie; distinct, each keypoint once, turned
/// consistently.
std::vector<orb::Match> MatchAlongEpipolarLines(const Frame& first, const Frame& second,
                                                const Camera& camera, const KeypointNoise& noise,
                                                double min_depth, int max_distance);

}  // namespace corvo
