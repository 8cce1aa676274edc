// SPDX-License-Identifier: MIT
#include "vo/mapping/landmark_fusion.h"

#include <algorithm>
#include <set>
#include <vector>

#include "vo/map/guided_matching.h"
#include "vo/map/landmark_alignment.h"
#include "vo/math/chi_square.h"
#include "vo/optimization/reprojection_error.h"

namespace corvo {
namespace {

/// Merges two landmarks into the one with more observations (the older one if equal).
LandmarkMerge Merge(Map& map, LandmarkId a, LandmarkId b) {
  const std::size_t num_a = map.FindLandmark(a)->track.size();
  const std::size_t num_b = map.FindLandmark(b)->track.size();
  const bool keep_a = num_a != num_b ? num_a > num_b : a < b;
  const LandmarkMerge merge{keep_a ? b : a, keep_a ? a : b};
  map.MergeLandmark(merge.from, merge.into);
  return merge;
}

/// Fuses landmarks with those observed by keyframes, one keyframe at a time.
class LandmarkFuser {
 public:
  LandmarkFuser(const LandmarkOptions& options, int max_distance, Map& map)
      : window_{options.fusion_radius_px, options.fusion_radius_px},
        matching_{max_distance},
        map_(map) {}

  void FuseInto(KeyframeId keyframe, const std::vector<LandmarkId>& landmarks) {
    const Frame& frame = map_.keyframe(keyframe).frame;
    const GuidedQueries queries = ProjectLandmarks(map_, SelectUnobserved(keyframe, landmarks),
                                                   frame.world_from_camera, window_);
    for (const orb::Match& match : MatchGuided(queries, frame, matching_)) {
      FuseKeypoint(queries.ids[match.query], {keyframe, match.train});
    }
  }

  FusedLandmarks TakeResult() { return std::move(fused_); }

 private:
  std::vector<LandmarkId> SelectUnobserved(KeyframeId keyframe,
                                           const std::vector<LandmarkId>& landmarks) const {
    std::vector<LandmarkId> unobserved;
    for (const LandmarkId id : landmarks) {
      const Landmark* landmark = map_.FindLandmark(id);
      if (landmark != nullptr && !landmark->IsObservedBy(keyframe)) unobserved.push_back(id);
    }
    return unobserved;
  }

  bool Fits(const Landmark& landmark, const TrackElement& element) const {
    const Frame& frame = map_.keyframe(element.keyframe).frame;
    const Eigen::Vector3d in_camera = frame.world_from_camera.Inverse() * landmark.in_world;
    const Observation observation = Observe(frame, element.keypoint, map_.model());
    return SquaredError(in_camera, observation, map_.camera()) <= kChiSquare2Dof95;
  }

  /// Makes a keypoint observe a landmark, if they are consistent. If the keypoint already observes
  /// another landmark, the two are merged.
  void FuseKeypoint(LandmarkId id, const TrackElement& element) {
    const Landmark* landmark = map_.FindLandmark(id);
    if (landmark == nullptr || landmark->IsObservedBy(element.keyframe)) return;
    if (!Fits(*landmark, element)) return;
    const LandmarkId present = map_.keyframe(element.keyframe).frame.landmarks[element.keypoint];
    if (present == kNoId) {
      map_.AddTrackElement(id, element);
      AlignTrackElement(id, element, map_);
    } else {
      fused_.merges.push_back(Merge(map_, id, present));
      id = fused_.merges.back().into;
      const std::vector<TrackElement> track = map_.FindLandmark(id)->track;
      for (const TrackElement& other : track) AlignTrackElement(id, other, map_);
    }
    map_.UpdateAppearance(id);
    ++fused_.num_fused;
  }

  LandmarkWindow window_;
  GuidedMatchingOptions matching_;
  Map& map_;
  FusedLandmarks fused_;
};

}  // namespace

FusedLandmarks FuseLandmarks(KeyframeId keyframe, const LandmarkOptions& options, int max_distance,
                             Map& map) {
  const std::vector<KeyframeId> neighbors =
      FirstKeyframes(map.FindCovisible(keyframe), options.num_neighbors);
  LandmarkFuser fuser(options, max_distance, map);
  std::set<LandmarkId> around;
  for (const KeyframeId neighbor : neighbors) {
    fuser.FuseInto(neighbor, map.LandmarksOf(keyframe));
    for (const LandmarkId id : map.LandmarksOf(neighbor)) around.insert(id);
  }
  fuser.FuseInto(keyframe, {around.begin(), around.end()});
  return fuser.TakeResult();
}

}  // namespace corvo
