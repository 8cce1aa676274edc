#pragma once

#include <optional>
#include <vector>

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
  void Add(const FrameResult& result) { records_.emplace_back().result = result; }

  /// What is known of a frame but for its pose and rotation.
  FrameResult& result(int frame) { return records_[frame].result; }

  bool IsPosed(int frame) const { return records_[frame].keyframe != kNoId; }
  void SetPose(int frame, KeyframeId keyframe, const SE3& keyframe_from_camera);
  /// Hangs the rotation of a frame on an earlier one; on itself, the frame begins a chain.
  void SetRotation(int frame, int reference, const SO3& reference_from_camera);

  /// Of a posed frame.
  SE3 PoseOf(int frame, const Map& map) const;
  /// Of a frame that is posed, or whose chain ends in a posed frame or at its beginning.
  std::optional<SO3> RotationOf(int frame, const Map& map) const;

  /// With pose and rotation as the map has them now.
  FrameResult ResultOf(int frame, const Map& map) const;
  Trajectory ToTrajectory(const Map& map) const;

 private:
  struct Record {
    FrameResult result;
    KeyframeId keyframe = kNoId;
    SE3 keyframe_from_camera;
    int reference = kNoId;
    SO3 reference_from_camera;
  };

  std::vector<Record> records_;
};

}  // namespace corvo
