// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "vo/core/conventions.h"
#include "vo/core/options.h"
#include "vo/lie/se3.h"
#include "vo/lie/sim3.h"
#include "vo/map/frame.h"
#include "vo/map/map.h"
#include "vo/tracking/motion_model.h"
#include "vo/tracking/scale_monitor.h"
#include "vo/tracking/speed_history.h"
#include "vo/tracking/tracker.h"

namespace corvo {

/// What is known of the camera's motion from the posed frames of the current segment.
class CameraMotion {
 public:
  explicit CameraMotion(const SegmentStartOptions& options) : speeds_(options) {}

  const MotionModel& model() const { return model_; }

  /// Adds the motion between two posed frames of one segment.
  void Add(const Frame& earlier, const Frame& later);

  /// Returns whether the scale of a frame that was just tracked is uncertain. See ScaleMonitor.
  bool IsScaleUncertain(const Map& map, const Frame& previous, const Frame& frame,
                        const TrackingResult& tracking);

  /// Returns the guessed speed of the camera at the start of a new segment, whose motions are added
  /// from now on.
  std::optional<SpeedGuess> StartSegment(TimeNs time_ns);
  /// Starts without any motion in a segment to which the camera returned.
  void EnterSegment();
  /// Expresses the speeds in another segment.
  void Transform(const Sim3& to_from_from);

 private:
  MotionModel model_;
  SpeedHistory speeds_;
  ScaleMonitor scale_monitor_;
};

}  // namespace corvo
