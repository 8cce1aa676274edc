// SPDX-License-Identifier: MIT
#include "vo/mapping/keyframe_location.h"

#include <unordered_set>
#include <vector>

#include "vo/optimization/landmark_pose.h"

namespace corvo {
namespace {

/// Locates keyframes one after the other.
class KeyframeLocator {
 public:
  KeyframeLocator(const Bundle& adjusted, const OdometryOptions& options, Map& map)
      : options_(options), map_(map) {
    for (const Bundle::Point& point : adjusted.points) known_.insert(point.landmark);
  }

  void Locate(KeyframeId id) {
    const Frame& frame = map_.keyframe(id).frame;
    const SE3 pose = frame.world_from_camera;
    const LandmarkPose located = OptimizeLandmarkPose(map_, frame, KnownLandmarksOf(frame),
                                                      correction_ * pose, options_.pose_optimizer);
    if (located.num_inliers >= options_.tracker.min_inliers) {
      correction_ = located.world_from_camera * pose.Inverse();
    }
    map_.SetPose(id, correction_ * pose);
    for (const LandmarkId landmark : map_.LandmarksOf(id)) MoveIfNew(landmark);
  }

 private:
  std::vector<LandmarkId> KnownLandmarksOf(const Frame& frame) const {
    std::vector<LandmarkId> landmarks = frame.landmarks;
    for (LandmarkId& id : landmarks) {
      if (!known_.contains(id)) id = kNoId;
    }
    return landmarks;
  }

  void MoveIfNew(LandmarkId id) {
    if (!known_.insert(id).second) return;
    map_.SetPosition(id, correction_ * map_.FindLandmark(id)->in_world);
  }

  const OdometryOptions& options_;
  Map& map_;
  std::unordered_set<LandmarkId> known_;  // Those that agree with the new camera.
  SE3 correction_;                        // Of the keyframe located last.
};

}  // namespace

void LocateNewerKeyframes(const Bundle& adjusted, const OdometryOptions& options, Map& map) {
  const KeyframeId newest = adjusted.views.back().keyframe;
  KeyframeLocator locator(adjusted, options, map);
  for (const KeyframeId id : map.ActiveKeyframes()) {
    if (id > newest && map.SegmentOf(id) == map.SegmentOf(newest)) locator.Locate(id);
  }
}

}  // namespace corvo
