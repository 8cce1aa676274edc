#include "vo/map/observation_recorder.h"

#include <map>

namespace corvo {
namespace {

void AddSighting(const Frame& frame, int keypoint, const Map& map, FrameSightings& sightings) {
  const Landmark* landmark = map.FindLandmark(frame.landmarks[keypoint]);
  if (landmark == nullptr) return;
  sightings.landmarks.push_back({landmark->id, frame.pixel(keypoint).cast<float>(),
                                 static_cast<float>(map.model().Sigma(frame, keypoint))});
  if (sightings.keyframe != kNoId) sightings.in_world.push_back(landmark->in_world);
}

void AddSightings(const Frame& frame, const Map& map, FrameSightings& sightings) {
  for (int k = 0; k < frame.num_keypoints(); ++k) AddSighting(frame, k, map, sightings);
}

}  // namespace

ObservationRecorder ObservationRecorder::WithSameCallbacks() const {
  ObservationRecorder recorder;
  recorder.sightings_sink_ = sightings_sink_;
  recorder.landmark_sink_ = landmark_sink_;
  return recorder;
}

void ObservationRecorder::AddMerges(const std::vector<LandmarkMerge>& merges) {
  if (!sightings_sink_) return;
  pending_merges_.insert(pending_merges_.end(), merges.begin(), merges.end());
}

void ObservationRecorder::RecordFrame(const Frame& frame, int segment, const Map& map) {
  if (!sightings_sink_) return;
  FrameSightings sightings{frame.index, segment, kNoId, {}, {}, {}};
  AddSightings(frame, map, sightings);
  sightings.merges.swap(pending_merges_);
  sightings_sink_(sightings);
}

void ObservationRecorder::RecordKeyframe(const Keyframe& keyframe, const Map& map) const {
  if (!sightings_sink_) return;
  sightings_sink_(SightingsOf(keyframe, map));
  std::map<KeyframeId, FrameSightings> last;
  for (const LandmarkId id : map.LandmarksOf(keyframe.id)) {
    const Landmark& landmark = *map.FindLandmark(id);
    if (landmark.observations.size() > 2) continue;
    for (const Observation& o : landmark.observations) {
      if (o.keyframe == keyframe.id) continue;
      const Frame& other = map.keyframe(o.keyframe).frame;
      const FrameSightings none{other.index, keyframe.segment, o.keyframe, {}, {}, {}};
      AddSighting(other, o.keypoint, map, last.try_emplace(o.keyframe, none).first->second);
    }
  }
  for (const auto& [other, sightings] : last) sightings_sink_(sightings);
}

void ObservationRecorder::RecordLandmarks(const std::vector<FinishedLandmark>& landmarks) const {
  if (!landmark_sink_) return;
  for (const FinishedLandmark& landmark : landmarks) landmark_sink_(landmark);
}

FrameSightings SightingsOf(const Keyframe& keyframe, const Map& map) {
  FrameSightings sightings{keyframe.frame.index, keyframe.segment, keyframe.id, {}, {}, {}};
  AddSightings(keyframe.frame, map, sightings);
  return sightings;
}

}  // namespace corvo
