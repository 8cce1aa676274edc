// SPDX-License-Identifier: MIT
#include "vo/tracking/camera_motion.h"

namespace corvo {

void CameraMotion::Add(const Frame& earlier, const Frame& later) {
  model_.Update(earlier, later);
  speeds_.Add(earlier, later);
}

bool CameraMotion::IsScaleUncertain(const Map& map, const Frame& previous, const Frame& frame,
                                    const TrackingResult& tracking) {
  const ScaleEvidence evidence = CollectScaleEvidence(map, previous, frame, tracking);
  return scale_monitor_.Add(evidence, [&] { return MeasureParallaxFlow(previous, frame); });
}

std::optional<SpeedGuess> CameraMotion::StartSegment(TimeNs time_ns) {
  const std::optional<SpeedGuess> guess = speeds_.Predict(time_ns);
  speeds_.Clear();
  scale_monitor_ = {};
  return guess;
}

void CameraMotion::EnterSegment() {
  model_ = {};
  speeds_.Clear();
  scale_monitor_ = {};
}

void CameraMotion::Transform(const Sim3& to_from_from) {
  speeds_.Transform(to_from_from);
  scale_monitor_ = {};
}

}  // namespace corvo
