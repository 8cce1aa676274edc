#pragma once

#include <functional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "vo/core/conventions.h"
#include "vo/map/map.h"
#include "vo/map/observation.h"

namespace corvo {

/// What a frame observed, for those who want to adjust a sequence afterwards: the map forgets it.
/// Each posed frame is reported once, when it is posed. A keyframe is reported again, with what is
/// known by then of the landmarks it observes, when it leaves the map for good; and before that,
/// with some of its landmarks, when these leave together with another keyframe.
struct FrameObservations {
  int frame = 0;
  int segment = 0;
  KeyframeId keyframe = kNoId;            ///< kNoId: reported when the frame was posed.
  std::vector<Observation> observations;  ///< Pixels and sigmas in single precision.
  std::vector<Eigen::Vector3d> in_world;  ///< The landmark of each; for keyframes only.
  std::vector<LandmarkMerge> merges;      ///< Of landmarks, since the previous posed frame.
};

using ObservationCallback = std::function<void(const FrameObservations&)>;

using LandmarkCallback = std::function<void(const MarginalizedLandmark&)>;

/// Reports what frames and keyframes observe, and the landmarks that leave the map, to callbacks.
/// Without a callback it does nothing.
class ObservationRecorder {
 public:
  void SetObservationCallback(ObservationCallback callback) {
    observation_callback_ = std::move(callback);
  }
  void SetLandmarkCallback(LandmarkCallback callback) { landmark_callback_ = std::move(callback); }

  /// A recorder that has recorded nothing.
  ObservationRecorder WithSameCallbacks() const;

  /// Remembers merges until the next posed frame is reported.
  void AddMerges(const std::vector<LandmarkMerge>& merges);
  /// Reports a frame that was just posed.
  void RecordFrame(const Frame& frame, int segment, const Map& map);
  /// Reports a keyframe that is about to leave the map, then the last observations, by other
  /// keyframes, of the landmarks that will leave with it.
  void RecordKeyframe(const Keyframe& keyframe, const Map& map) const;
  void RecordLandmarks(const std::vector<MarginalizedLandmark>& landmarks) const;

 private:
  ObservationCallback observation_callback_;
  LandmarkCallback landmark_callback_;
  std::vector<LandmarkMerge> pending_merges_;
};

/// What an active keyframe observes.
FrameObservations ObservationsOf(const Keyframe& keyframe, const Map& map);

}  // namespace corvo
