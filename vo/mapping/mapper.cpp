// SPDX-License-Identifier: MIT
#include "vo/mapping/mapper.h"

#include <limits>

#include "vo/map/landmark_alignment.h"
#include "vo/mapping/culling.h"
#include "vo/mapping/landmark_creation.h"
#include "vo/mapping/landmark_fusion.h"

namespace corvo {

Mapper::Mapper(const CameraPrior& prior, const OdometryOptions& options)
    : options_(options),
      adjuster_(prior, options),
      uncertainty_(adjuster_.camera_prior(), options.bundle_adjuster) {}

KeyframeId Mapper::InsertInitialMap(const InitialMap& initial, int segment, Frame& first,
                                    Frame& second, Map& map) {
  second.world_from_camera = first.world_from_camera * initial.first_from_second;
  // The first frame may have landmarks of the previous segment.
  first.landmarks.assign(first.landmarks.size(), kNoId);
  const KeyframeId first_id = map.AddKeyframe(first, segment);
  const KeyframeId second_id = map.AddKeyframe(second, segment);
  for (const InitialPoint& point : initial.points) {
    const TrackElement in_second{second_id, point.second_keypoint};
    const LandmarkId id = map.AddLandmark(first.world_from_camera * point.in_first,
                                          {{first_id, point.first_keypoint}, in_second});
    AlignTrackElement(id, in_second, map);
    map.UpdateAppearance(id);
    probation_.push_back(id);
  }
  uncertainty_.ComputeWindow(map, second_id);
  edges_.AddKeyframe(map, uncertainty_, camera_estimate());
  first.landmarks = map.keyframe(first_id).frame.landmarks;
  second.landmarks = map.keyframe(second_id).frame.landmarks;
  return first_id;
}

KeyframeId Mapper::InsertKeyframe(Frame& frame, int segment, Map& map) {
  uncertainty_.AddKeyframe(map, frame);
  const KeyframeId keyframe = map.AddKeyframe(frame, segment);
  for (const LandmarkId id : map.LandmarksOf(keyframe)) map.UpdateAppearance(id);
  CullLandmarks(options_.culling, probation_, map);
  const LandmarkId first_new = map.num_landmark_ids();
  CreateLandmarks(keyframe, options_.landmarks, options_.matching.max_distance, map);
  for (LandmarkId id = first_new; id < map.num_landmark_ids(); ++id) probation_.push_back(id);
  edges_.AddKeyframe(map, uncertainty_, camera_estimate());
  unfused_ = keyframe;
  frame.landmarks = map.keyframe(keyframe).frame.landmarks;
  return keyframe;
}

void Mapper::AdaptToJoin(const SegmentJoin& join, const Map& map) {
  edges_.JoinSegments(join);
  adjuster_.AdaptToJoin();
  unfused_ = map.num_keyframes() - 1;
  uncertainty_.ComputeWindow(map, unfused_);
}

PoseGraph Mapper::GetPoseGraph(const Map& map) const {
  PoseGraph graph = edges_.ToGraph(map);
  graph.camera_covariance = camera_estimate().covariance;
  return graph;
}

std::optional<UncertaintyToKeyframe> Mapper::UncertaintyOf(const Frame& frame, const Map& map) {
  const KeyframeId newest = map.num_keyframes() - 1;
  const bool is_newest = map.keyframe(newest).frame.index == frame.index;
  return is_newest ? uncertainty_.OfNewestKeyframe(map, frame, camera_estimate())
                   : uncertainty_.OfFrame(map, frame, camera_estimate());
}

MapUpdate Mapper::Update(int frame, Map& map, ObservationRecorder& recorder, StageClock& clock) {
  const MapUpdate update = UseAdjustments(frame, map, recorder, clock);
  if (map.empty()) return update;
  const StageClock::Scope mapping(clock, &StageTimes::map_ms);
  FuseLandmarks(map, recorder);
  const StageClock::Scope adjusting(clock, &StageTimes::adjust_ms);
  StartAdjustment(frame, map);
  return update;
}

MapUpdate Mapper::Finish(Map& map, ObservationRecorder& recorder, StageClock& clock) {
  const StageClock::Scope mapping(clock, &StageTimes::map_ms);
  FuseLandmarks(map, recorder);
  return UseAdjustments(std::numeric_limits<int>::max(), map, recorder, clock);
}

MapUpdate Mapper::UseAdjustments(int frame, Map& map, const ObservationRecorder& recorder,
                                 StageClock& clock) {
  MapUpdate update;
  {
    const StageClock::Scope adjusting(clock, &StageTimes::adjust_ms);
    update.adjustments = adjuster_.UseResults(frame, map);
    if (IsUsable(update.adjustments.window)) {
      uncertainty_.UseWindow(adjuster_.window_covariance());
      edges_.Renew(map, uncertainty_, camera_estimate());
    }
  }
  if (!update.adjustments.any()) return update;
  const StageClock::Scope mapping(clock, &StageTimes::map_ms);
  update.culled = CullKeyframes(map.num_keyframes() - 1, options_.culling, map);
  Marginalize(map, recorder);
  return update;
}

void Mapper::FuseLandmarks(Map& map, ObservationRecorder& recorder) {
  if (unfused_ == kNoId) return;
  recorder.AddMerges(
      corvo::FuseLandmarks(unfused_, options_.landmarks, options_.matching.max_distance, map)
          .merges);
  map.DropPatches(unfused_ - options_.landmarks.num_aligned_keyframes);
  unfused_ = kNoId;
}

void Mapper::Marginalize(Map& map, const ObservationRecorder& recorder) const {
  recorder.RecordLandmarks(MarginalizeKeyframes(
      options_.relocalizer.max_keyframes,
      [&](const Keyframe& keyframe) { recorder.RecordKeyframe(keyframe, map); }, map));
}

}  // namespace corvo
