// SPDX-License-Identifier: MIT
#include "vo/tracking/relocalizer.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include "orb/matcher.h"

namespace corvo {
namespace {

/// Returns the landmark with the nearest descriptor for each keypoint of the frame that has one
/// within `max_distance` bits.
std::vector<LandmarkId> FindSimilar(const Map& map, const std::vector<LandmarkId>& landmarks,
                                    int max_distance, const Frame& frame) {
  std::vector<orb::Descriptor> descriptors;
  for (const LandmarkId id : landmarks) descriptors.push_back(map.FindLandmark(id)->descriptor);
  std::vector<LandmarkId> similar;
  const std::vector<orb::Nearest> nearest =
      orb::FindNearest(frame.features.descriptors, descriptors);
  for (const orb::Match& match : orb::DistanceTest(nearest, max_distance)) {
    similar.push_back(landmarks[match.train]);
  }
  return similar;
}

/// Returns the keyframes that observe the most of `landmarks`, in descending order of their number.
std::vector<KeyframeId> SelectCandidates(const Map& map, const std::vector<KeyframeId>& keyframes,
                                         const std::vector<LandmarkId>& landmarks,
                                         int max_candidates) {
  std::map<KeyframeId, int> votes;
  for (const LandmarkId id : landmarks) {
    for (const TrackElement& observation : map.FindLandmark(id)->track) {
      ++votes[observation.keyframe];
    }
  }
  std::vector<KeyframeId> candidates = keyframes;
  std::stable_sort(candidates.begin(), candidates.end(),
                   [&](KeyframeId a, KeyframeId b) { return votes[a] > votes[b]; });
  if (static_cast<int>(candidates.size()) > max_candidates) candidates.resize(max_candidates);
  return candidates;
}

}  // namespace

Relocalizer::Relocalizer(const OdometryOptions& options)
    : options_(options.relocalizer), matching_(options.matching), tracker_(options) {}

TrackingResult Relocalizer::Relocalize(int segment, Map& map, Frame& frame) const {
  std::vector<KeyframeId> keyframes = map.ActiveKeyframes();
  std::erase_if(keyframes, [&](KeyframeId id) { return map.SegmentOf(id) != segment; });
  TrackingResult tracking = RelocalizeAmong(std::move(keyframes), map, frame);
  if (tracking.is_tracked()) return tracking;
  TrackingResult elsewhere = RelocalizeElsewhere(segment, map, frame);
  return elsewhere.is_tracked() ? elsewhere : tracking;
}

TrackingResult Relocalizer::RelocalizeElsewhere(int segment, Map& map, Frame& frame) const {
  std::vector<KeyframeId> keyframes = map.ActiveKeyframes();
  std::erase_if(keyframes, [&](KeyframeId id) { return map.SegmentOf(id) == segment; });
  return RelocalizeAmong(std::move(keyframes), map, frame);
}

TrackingResult Relocalizer::RelocalizeAmong(std::vector<KeyframeId> keyframes, Map& map,
                                            Frame& frame) const {
  std::reverse(keyframes.begin(), keyframes.end());
  if (static_cast<int>(keyframes.size()) > options_.max_keyframes) {
    keyframes.resize(options_.max_keyframes);
  }
  const std::vector<LandmarkId> similar =
      FindSimilar(map, map.FindObserved(keyframes), matching_.max_tracking_distance, frame);
  TrackingResult best;
  best.reason = Reason::kTooFewMatches;
  for (const KeyframeId id : SelectCandidates(map, keyframes, similar, options_.max_candidates)) {
    map.UpdateRays(id);
    const Frame& keyframe = map.keyframe(id).frame;
    TrackingResult tracking = tracker_.Track(map, keyframe, {keyframe.world_from_camera}, frame);
    if (tracking.is_tracked() && tracking.num_inliers >= options_.min_inliers) return tracking;
    if (tracking.num_inliers > best.num_inliers) {
      best = std::move(tracking);
      best.reason = Reason::kTooFewInliers;
    }
  }
  return best;
}

int SegmentOf(const Map& map, const Frame& frame) {
  for (const LandmarkId id : frame.landmarks) {
    const Landmark* landmark = map.FindLandmark(id);
    if (landmark != nullptr) return landmark->segment;
  }
  return kNoId;
}

}  // namespace corvo
