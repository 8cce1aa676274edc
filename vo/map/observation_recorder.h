#pragma once

#include <functional>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "vo/core/conventions.h"
#include "vo/map/map.h"

namespace corvo {

/// A landmark as a frame saw it.
struct Observation {
  LandmarkId landmark = kNoId;
  Eigen::Vector2f pixel;
  float sigma_px = 1;

  bool operator==(const Observation&) const = default;
};

/// What a frame observed, for those who want to adjust a sequence afterwards: the map forgets it.
/// Each posed frame is reported once, when it is posed. A keyframe is reported again, with what is
/// known by then of the landmarks it observes, when it leaves the map for good; and before that,
/// with some of its landmarks, when these leave together with another keyframe.
struct FrameObservations {
  int frame = 0;
  int segment = 0;
  KeyframeId keyframe = kNoId;  ///< kNoId: reported when the frame was posed.
  std::vector<Observation> landmarks;
  std::vector<Eigen::Vector3d> in_world;  ///< Of each of `landmarks`; for keyframes only.
  std::vector<LandmarkMerge> merges;      ///< Of landmarks, since the previous posed frame.
};

using ObservationCallback = std::function<void(const FrameObservations&)>;

/// Calls a sink with everything that an odometry gave to its own, in the same order.
using ObservationSource = std::function<void(const ObservationCallback&)>;

using LandmarkCallback = std::function<void(const MarginalizedLandmark&)>;

/// Reports what frames and keyframes observe, and the landmarks that leave the map, to callbacks.
/// Without a callback it does nothing.
class ObservationRecorder {
 public:
  void SetObservationCallback(ObservationCallback sink) { observation_callback_ = std::move(sink); }
  void SetLandmarkCallback(LandmarkCallback sink) { landmark_callback_ = std::move(sink); }

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
