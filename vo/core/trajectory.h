// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vo/core/frame_result.h"
#include "vo/lie/se3.h"

namespace corvo {

/// A pose at a time. x_in_world = world_from_camera * x_in_camera.
struct TimedPose {
  TimeNs time_ns = 0;
  SE3 world_from_camera;
};

/// Poses in ascending time.
using PoseSequence = std::vector<TimedPose>;

/// What became of every input frame, one entry a frame, in input order.
struct Trajectory {
  std::vector<FrameResult> frames;

  PoseSequence PosedFrames() const;
  /// The rotation of every frame that has one, posed or not, all at the origin.
  PoseSequence Rotations() const;
  double PosedShare() const;  ///< Of all frames, 0 to 1.
};

/// With `scale` times the lengths.
Trajectory Scale(double scale, Trajectory trajectory);

}  // namespace corvo
