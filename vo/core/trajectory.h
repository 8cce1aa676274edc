// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "vo/core/frame_result.h"
#include "vo/core/segment.h"
#include "vo/lie/se3.h"

namespace corvo {

/// The largest magnitude of a coordinate of a position that is read, evaluated or written.
inline constexpr double kMaxCoordinate = 1e24;

/// Throws corvo::Error, whose message starts with `name`, unless the pose is finite and every
/// coordinate of its position is -kMaxCoordinate to kMaxCoordinate.
void CheckPose(const std::string& name, const SE3& pose);

/// A pose and its timestamp: x_in_world = world_from_camera * x_in_camera.
struct TimedPose {
  TimeNs time_ns = 0;
  SE3 world_from_camera;
};

/// Poses in ascending order of time.
using PoseSequence = std::vector<TimedPose>;

/// The results of all input frames, one per frame, in input order.
struct Trajectory {
  std::vector<FrameResult> frames;
  std::vector<SegmentScale> scales = {};  ///< By index of the segment; arbitrary if left out.

  PoseSequence PosedFrames() const;
  /// Returns the rotation of every frame that has one, posed or not, with a translation of zero.
  PoseSequence Rotations() const;
  double PosedShare() const;  ///< Share of frames that are posed, 0 to 1.
  /// Returns the segments that have poses, in order.
  std::vector<Segment> Segments() const;
};

/// Computes the relative poses of all frames from their poses in the world, which were changed. A
/// relative pose whose reference is no longer a posed frame of the same segment is removed.
void UpdateRelativePoses(Trajectory& trajectory);

}  // namespace corvo
