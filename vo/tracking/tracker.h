#pragma once

#include <vector>

#include "vo/camera/camera.h"
#include "vo/core/frame_result.h"
#include "vo/core/options.h"
#include "vo/map/frame.h"
#include "vo/map/keypoint_noise.h"
#include "vo/map/map.h"

namespace corvo {

/// What became of a frame that was looked for in the map.
struct TrackingResult {
  Reason reason = Reason::kNone;    ///< kNone: the frame's pose and landmarks are set.
  int num_matches = 0;              ///< Keypoints matched with landmarks.
  int num_inliers = 0;              ///< Of num_matches, those that agree with the pose.
  std::vector<LandmarkId> visible;  ///< Landmarks that should be seen from the pose.
};

/// Locates `frame` in the map. Landmarks of the frame before are matched near where `predicted`
/// puts them (wider, where few were found or most of them disagree with one pose; at last anywhere,
/// with a robust perspective-n-point pose), which gives a pose; the landmarks of the keyframes
/// around are then projected and matched, and the pose refined. On success sets the frame's pose
/// and landmarks.
TrackingResult TrackFrame(const Map& map, const Frame& previous, const SE3& predicted,
                          const Camera& camera, const KeypointNoise& noise,
                          const TrackerOptions& options, Frame& frame);

}  // namespace corvo
