// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <optional>

#include "vo/core/adjustment_status.h"
#include "vo/core/conventions.h"
#include "vo/core/frame_result.h"
#include "vo/core/trajectory.h"
#include "vo/lie/se3.h"
#include "vo/lie/so3.h"
#include "vo/map/map.h"

namespace corvo {

/// Matches of a frame with landmarks, and those that agree with its pose.
struct MatchCounts {
  int num_matches = 0;
  int num_inliers = 0;
};

/// The result of every input frame, in input order. A posed frame hangs on the keyframes of its
/// segment before and after it: where these move against each other, it moves as they do, weighted
/// by how near it is to either. With a keyframe on one side only it moves as that does. A frame of
/// which only the rotation is known hangs on another frame.
class FrameHistory {
 public:
  int size() const { return static_cast<int>(records_.size()); }
  /// Throws corvo::Error unless `time_ns`, of the frame to come, is after that of the newest frame.
  void CheckNext(TimeNs time_ns) const;
  /// A frame that was not located yet.
  void Add(const Frame& frame);
  /// A frame whose image repeats that of the last frame added by Add: it has that one's outcome and
  /// pose, also where these are found or change afterwards. Returns its index.
  int AddRepeat(TimeNs time_ns);

  FrameOutcome& outcome(int frame) { return records_[frame].outcome; }

  /// Notes in the newest frame's account how adjustments ended. A failure stays noted when more
  /// adjustments end after the last frame.
  void AddAdjustments(const UsedAdjustments& used);
  /// The frame was located in a segment that has a keyframe.
  void SetTracked(const Frame& frame, int segment, const MatchCounts& counts, const Map& map);

  bool IsPosed(int frame) const { return records_[frame].keyframe != kNoId; }
  /// In a segment that has a keyframe.
  void SetPose(int frame, int segment, const SE3& world_from_camera, const Map& map);
  /// The newest keyframe of the map; its frame is posed with it and told to be a keyframe, if it is
  /// not posed yet (in the segment before).
  void AddKeyframe(int frame, KeyframeId keyframe, const Map& map);
  /// One that was retired since the map changed last, and was not its segment's first or newest:
  /// frames hang on those around it.
  void RemoveKeyframe(KeyframeId keyframe, const Map& map);
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

  std::size_t num_bytes() const {
    return records_.size() * sizeof(Record) + keyframes_.size() * sizeof(Keyframes::value_type);
  }

 private:
  struct Record {
    FrameOutcome outcome;
    KeyframeId keyframe = kNoId;  // Of a posed frame: the last before it, or the first after it.
    int reference = kNoId;        // Of a frame of which only the rotation is known.
    SE3 from_camera;              // Its target is whichever of the two there is.
  };
  struct Keyframe {
    int frame = kNoId;
    SE3 from_before;  // From the keyframe before in its segment, when they became neighbors.
  };
  using Keyframes = std::map<KeyframeId, Keyframe>;

  /// The keyframe that a frame hangs on.
  KeyframeId FindKeyframe(int frame, int segment, const Map& map) const;
  /// Sets what `keyframe` and the one before it are to each other now.
  void Join(Keyframes::iterator keyframe, const Map& map);

  std::deque<Record> records_;
  Keyframes keyframes_;
};

}  // namespace corvo
