#pragma once

#include "vo/camera/camera.h"
#include "vo/core/options.h"
#include "vo/map/frame.h"
#include "vo/map/keypoint_noise.h"
#include "vo/map/map.h"
#include "vo/tracking/tracker.h"

namespace corvo {

/// Locates a frame without any idea of where it is, in the map of one segment. Each keypoint votes
/// for the newest keyframes that see the landmark most like it; the frame is then tracked from the
/// keyframes with the most votes, one after the other, until enough landmarks agree with a pose.
/// On success sets the frame's pose and landmarks. The map's keyframes get their rays by `camera`,
/// where they had them by another.
TrackingResult Relocalize(Map& map, int segment, const Camera& camera, const KeypointNoise& noise,
                          const TrackerOptions& tracker, const RelocalizerOptions& options,
                          Frame& frame);

}  // namespace corvo
