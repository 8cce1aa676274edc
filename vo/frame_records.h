#pragma once

#include <cstddef>
#include <deque>
#include <optional>

#include "vo/conventions.h"
#include "vo/frame_result.h"
#include "vo/lie/se3.h"
#include "vo/lie/so3.h"
#include "vo/map.h"
#include "vo/trajectory.h"

namespace corvo {

/// The result of every input frame, in input order. A posed frame hangs on a keyframe and moves
/// with it; a frame of which only the rotation is known hangs on another frame.
class FrameRecords {
 public:
  int size() const { return static_cast<int>(records_.size()); }
  void Add(const FrameOutcome& outcome) { records_.emplace_back().outcome = outcome; }

  FrameOutcome& outcome(int frame) { return records_[frame].outcome; }

  bool IsPosed(int frame) const { return records_[frame].keyframe != kNoId; }
  void SetPose(int frame, KeyframeId keyframe, const SE3& keyframe_from_camera);
  /// Hangs the rotation of a frame that is not posed on an earlier one; on itself, the frame begins
  /// a chain.
  void SetRotation(int frame, int reference, const SO3& reference_from_camera);

  /// Of a posed frame.
  SE3 PoseOf(int frame, const Map& map) const;
  /// Of a frame that is posed, or whose chain ends in a posed frame or at its beginning.
  std::optional<SO3> RotationOf(int frame, const Map& map) const;

  /// With pose and rotation as the map has them now.
  FrameResult ResultOf(int frame, const Map& map) const;
  Trajectory ToTrajectory(const Map& map) const;

  std::size_t num_bytes() const { return records_.size() * sizeof(Record); }

 private:
  struct Record {
    FrameOutcome outcome;
    KeyframeId keyframe = kNoId;  // Of a posed frame.
    int reference = kNoId;        // Of a frame of which only the rotation is known.
    SE3 from_camera;              // Its target is whichever of the two there is.
  };

  std::deque<Record> records_;
};

}  // namespace corvo
