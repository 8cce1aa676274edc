// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vo/core/conventions.h"
#include "vo/lie/se3.h"
#include "vo/map/frame.h"

namespace corvo {

/// Predicts poses from the last motion.
class MotionModel {
 public:
  /// Sets the expected motion to that between two posed frames.
  void Update(const Frame& earlier, const Frame& later);

  /// Returns the expected world_from_camera at `time_ns`, starting at a posed frame. Before the
  /// first Update(), this is the frame's own pose.
  SE3 Predict(const Frame& from, TimeNs time_ns) const;

  /// Returns the poses that are likely at `time_ns`, the likeliest first: that of constant
  /// velocity; that after the same motion again, whatever the timestamps say, since clocks stutter
  /// and frames are dropped unnoticed; and that of a camera that has stopped.
  std::vector<SE3> PredictAlternatives(const Frame& from, TimeNs time_ns) const;

 private:
  SE3 earlier_from_later_;
  TimeNs step_ns_ = 0;  // Duration of the motion; 0 before the first Update().
};

}  // namespace corvo
