// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

#include "vo/map/map.h"
#include "vo/map/observation_callback.h"

namespace corvo {

/// Reports the observations of frames and keyframes, and the marginalized landmarks, to callbacks.
/// Without a callback it does nothing.
class ObservationRecorder {
 public:
  void SetObservationCallback(ObservationCallback callback) {
    observation_callback_ = std::move(callback);
  }
  void SetLandmarkCallback(LandmarkCallback callback) { landmark_callback_ = std::move(callback); }

  /// Returns a recorder with the same callbacks that has recorded nothing.
  ObservationRecorder WithSameCallbacks() const;

  /// Stores merges until the next posed frame is reported.
  void AddMerges(const std::vector<LandmarkMerge>& merges);
  /// Reports a frame that was just posed.
  void RecordFrame(const Frame& frame, int segment, const Map& map);
  /// Reports a keyframe that is about to be marginalized, then the last observations, in other
  /// keyframes, of the landmarks that will be marginalized with it.
  void RecordKeyframe(const Keyframe& keyframe, const Map& map) const;
  void RecordLandmarks(const std::vector<MarginalizedLandmark>& landmarks) const;

 private:
  ObservationCallback observation_callback_;
  LandmarkCallback landmark_callback_;
  std::vector<LandmarkMerge> pending_merges_;
};

/// Returns the observations of an active keyframe.
FrameObservations ObservationsOf(const Keyframe& keyframe, const Map& map);

}  // namespace corvo
