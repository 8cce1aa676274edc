// SPDX-License-Identifier: MIT
#include "vo/mapping/keyframe_policy.h"

namespace corvo {
namespace {

int CountEstablished(const Map& map, KeyframeId id) {
  const KeyframeId third_newest = map.num_keyframes() - 3;
  const bool has_three = third_newest >= 0 && map.SegmentOf(third_newest) == map.SegmentOf(id);
  const std::size_t min_observations = has_three ? 3 : 2;
  int count = 0;
  for (const LandmarkId landmark : map.LandmarksOf(id)) {
    count += map.FindLandmark(landmark)->track.size() >= min_observations;
  }
  return count;
}

}  // namespace

KeyframeEvidence CollectEvidence(const Map& map, const Frame& frame) {
  const KeyframeId reference = map.FindCovisible(frame).front().keyframe;
  return {frame.num_keypoints(), CountObservedLandmarks(frame), CountEstablished(map, reference)};
}

bool NeedsKeyframe(const KeyframeEvidence& evidence, const KeyframeOptions& options) {
  return evidence.num_tracked < options.max_tracked_share * evidence.num_reference ||
         evidence.num_tracked < options.min_seeing_share * evidence.num_keypoints;
}

}  // namespace corvo
