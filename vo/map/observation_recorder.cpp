// SPDX-License-Identifier: MIT
#include "vo/map/observation_recorder.h"

#include <map>

namespace corvo {
namespace {

FrameObservations EmptyReport(int frame, int segment, KeyframeId keyframe, const Map& map) {
  return {frame, segment, keyframe, {}, {}, {}, map.num_joins(), map.first_landmark_id()};
}

void AddObservation(const Frame& frame, int k, const Map& map, FrameObservations& added) {
  const Landmark* landmark = map.FindLandmark(frame.landmarks[k]);
  if (landmark == nullptr) return;
  Observation observation = Observe(frame, k, map.model());
  observation.pixel = observation.pixel.cast<float>().cast<double>();
  observation.sigma_px = static_cast<float>(observation.sigma_px);
  added.observations.push_back(observation);
  if (added.keyframe != kNoId) added.in_world.push_back(landmark->in_world);
}

void AddObservations(const Frame& frame, const Map& map, FrameObservations& added) {
  for (int k = 0; k < frame.num_keypoints(); ++k) AddObservation(frame, k, map, added);
}

}  // namespace

ObservationRecorder ObservationRecorder::WithSameCallbacks() const {
  ObservationRecorder recorder;
  recorder.observation_callback_ = observation_callback_;
  recorder.landmark_callback_ = landmark_callback_;
  return recorder;
}

void ObservationRecorder::AddMerges(const std::vector<LandmarkMerge>& merges) {
  if (!observation_callback_) return;
  pending_merges_.insert(pending_merges_.end(), merges.begin(), merges.end());
}

void ObservationRecorder::RecordFrame(const Frame& frame, int segment, const Map& map) {
  if (!observation_callback_) return;
  FrameObservations observations = EmptyReport(frame.index, segment, kNoId, map);
  AddObservations(frame, map, observations);
  observations.merges.swap(pending_merges_);
  observation_callback_(observations);
}

void ObservationRecorder::RecordKeyframe(const Keyframe& keyframe, const Map& map) const {
  if (!observation_callback_) return;
  observation_callback_(ObservationsOf(keyframe, map));
  std::map<KeyframeId, FrameObservations> last;
  for (const LandmarkId id : map.LandmarksOf(keyframe.id)) {
    const Landmark& landmark = *map.FindLandmark(id);
    if (landmark.track.size() > 2) continue;
    for (const TrackElement& o : landmark.track) {
      if (o.keyframe == keyframe.id) continue;
      const Frame& other = map.keyframe(o.keyframe).frame;
      const FrameObservations none = EmptyReport(other.index, keyframe.segment, o.keyframe, map);
      AddObservation(other, o.keypoint, map, last.try_emplace(o.keyframe, none).first->second);
    }
  }
  for (const auto& [other, observations] : last) observation_callback_(observations);
}

void ObservationRecorder::RecordLandmarks(
    const std::vector<MarginalizedLandmark>& landmarks) const {
  if (!landmark_callback_) return;
  for (const MarginalizedLandmark& landmark : landmarks) landmark_callback_(landmark);
}

FrameObservations ObservationsOf(const Keyframe& keyframe, const Map& map) {
  FrameObservations observations =
      EmptyReport(keyframe.frame.index, keyframe.segment, keyframe.id, map);
  AddObservations(keyframe.frame, map, observations);
  return observations;
}

}  // namespace corvo
