#include "vo/mapping/landmark_fusion.h"

#include <set>
#include <vector>

#include "orb/matcher.h"
#include "vo/map/landmark_alignment.h"
#include "vo/map/landmark_projection.h"
#include "vo/math/chi_square.h"
#include "vo/optimization/pose_optimizer.h"

namespace corvo {
namespace {

bool Sees(const Landmark& landmark, KeyframeId keyframe) {
  for (const Observation& o : landmark.observations) {
    if (o.keyframe == keyframe) return true;
  }
  return false;
}

/// Landmarks that a keyframe might see but does not, matched with its keypoints.
struct Candidates {
  std::vector<LandmarkId> landmarks;
  std::vector<orb::Match> matches;  ///< Query: index in `landmarks`; train: keypoint.
};

Candidates MatchIntoKeyframe(const Map& map, const std::vector<LandmarkId>& landmarks,
                             const Keyframe& keyframe, const Camera& camera,
                             const KeypointNoise& noise, int max_distance) {
  constexpr double kRadius = 3.0;
  Candidates candidates;
  std::vector<orb::Descriptor> descriptors;
  std::vector<orb::SearchWindow> windows;
  for (const LandmarkId id : landmarks) {
    const Landmark* landmark = map.FindLandmark(id);
    if (landmark == nullptr || Sees(*landmark, keyframe.id)) continue;
    const auto view =
        ProjectLandmark(*landmark, keyframe.frame.world_from_camera, camera, noise.octave_scales);
    if (!view) continue;
    candidates.landmarks.push_back(id);
    descriptors.push_back(landmark->descriptor);
    windows.push_back(view->Window(kRadius * noise.octave_scales[view->octave], 1, 0));
  }
  candidates.matches = orb::KeepUnique(orb::KeepNear(
      orb::FindNearestInWindows(descriptors, windows, keyframe.frame.features.descriptors,
                                keyframe.frame.keypoint_index),
      max_distance));
  return candidates;
}

/// Merges two landmarks into the one with more observations (the older of equals).
LandmarkMerge Merge(Map& map, LandmarkId a, LandmarkId b) {
  const std::size_t num_a = map.FindLandmark(a)->observations.size();
  const std::size_t num_b = map.FindLandmark(b)->observations.size();
  const bool keep_a = num_a != num_b ? num_a > num_b : a < b;
  const LandmarkMerge merge{keep_a ? b : a, keep_a ? a : b};
  map.MergeLandmark(merge.from, merge.into);
  return merge;
}

void FuseInto(Map& map, const std::vector<LandmarkId>& landmarks, KeyframeId id,
              const Camera& camera, const KeypointNoise& noise, int max_distance,
              FusedLandmarks& fused) {
  const Keyframe& keyframe = map.keyframe(id);
  const Candidates candidates =
      MatchIntoKeyframe(map, landmarks, keyframe, camera, noise, max_distance);
  const SE3 camera_from_world = keyframe.frame.world_from_camera.Inverse();
  for (const orb::Match& match : candidates.matches) {
    LandmarkId landmark = candidates.landmarks[match.query];
    if (map.FindLandmark(landmark) == nullptr || Sees(*map.FindLandmark(landmark), id)) continue;
    const PointObservation observation{map.FindLandmark(landmark)->in_world,
                                       keyframe.frame.pixel(match.train),
                                       noise.Sigma(keyframe.frame, match.train)};
    if (SquaredError(observation, camera_from_world, camera) > kChiSquare2Dof95) continue;
    const LandmarkId present = keyframe.frame.landmarks[match.train];
    if (present == kNoId) {
      map.AddObservation(landmark, {id, match.train});
      AlignObservation(landmark, {id, match.train}, camera, noise.octave_scales, map);
    } else {
      fused.merges.push_back(Merge(map, landmark, present));
      landmark = fused.merges.back().into;
      for (const Observation& o :
           std::vector<Observation>(map.FindLandmark(landmark)->observations)) {
        AlignObservation(landmark, o, camera, noise.octave_scales, map);
      }
    }
    map.UpdateAppearance(landmark, noise.octave_scales);
    ++fused.num_fused;
  }
}

std::vector<LandmarkId> LandmarksOf(const Map& map, KeyframeId id) {
  std::vector<LandmarkId> landmarks;
  for (const LandmarkId landmark : map.keyframe(id).frame.landmarks) {
    if (landmark != kNoId) landmarks.push_back(landmark);
  }
  return landmarks;
}

}  // namespace

FusedLandmarks FuseLandmarks(Map& map, KeyframeId keyframe, const Camera& camera,
                             const KeypointNoise& noise, const KeyframeOptions& options) {
  std::vector<Covisible> neighbors = map.FindCovisible(keyframe);
  if (static_cast<int>(neighbors.size()) > options.num_neighbors) {
    neighbors.resize(options.num_neighbors);
  }
  FusedLandmarks fused;
  std::set<LandmarkId> around;
  for (const Covisible& neighbor : neighbors) {
    FuseInto(map, LandmarksOf(map, keyframe), neighbor.keyframe, camera, noise,
             options.max_distance, fused);
    for (const LandmarkId id : LandmarksOf(map, neighbor.keyframe)) around.insert(id);
  }
  FuseInto(map, {around.begin(), around.end()}, keyframe, camera, noise, options.max_distance,
           fused);
  return fused;
}

}  // namespace corvo
