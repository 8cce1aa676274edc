// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "vo/core/conventions.h"
#include "vo/lie/se3.h"
#include "vo/map/frame.h"

namespace corvo {

/// Predicts poses by constant velocity.
class MotionModel {
 public:
  /// Takes the motion between two posed frames as the one to expect.
  void Update(const Frame& earlier, const Frame& later);

  /// The expected world_from_camera at a time, from a posed frame on. The frame's own pose before
  /// any motion is known.
  SE3 Predict(const Frame& from, TimeNs time_ns) const;

  /// The distance that the camera is expected to move in a time. None before any motion is known,
  /// and while standing still.
  std::optional<double> ExpectedDistance(TimeNs duration_ns) const;

 private:
  SE3 earlier_from_later_;
  TimeNs step_ns_ = 0;  // How long that motion took; 0 before any is known.
};

}  // namespace corvo
