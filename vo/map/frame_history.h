// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "vo/core/adjustment_status.h"
#include "vo/core/conventions.h"
#include "vo/core/frame_result.h"
#include "vo/core/segment.h"
#include "vo/core/trajectory.h"
#include "vo/lie/se3.h"
#include "vo/lie/so3.h"
#include "vo/map/map.h"

namespace corvo {

/// The number of matches of a frame with landmarks, and the number of inliers of its pose.
struct MatchCounts {
  int num_matches = 0;
  int num_inliers = 0;
};

/// The results of all input frames, in input order. A posed frame is expressed relative to the
/// keyframes of its segment before and after it: if these move relative to each other, the frame
/// follows both, weighted by its distance to each. With a keyframe on one side only, it follows
/// that one. A frame of which only the rotation is known is expressed relative to another frame.
class FrameHistory {
 public:
  int size() const { return static_cast<int>(records_.size()); }
  /// Throws corvo::Error unless `time_ns`, the timestamp of the next frame, is after that of the
  /// newest frame.
  void CheckNext(TimeNs time_ns) const;
  /// Adds a frame that is not located yet. Returns its index.
  int Add(TimeNs time_ns);
  /// Sets the outcome of the extraction of a frame's features.
  void SetFeatures(const Frame& frame);
  /// Adds a frame without an image. Returns its index.
  int AddMissing(TimeNs time_ns, Reason reason);
  /// A frame whose image repeats that of the last frame added by Add: it has that one's outcome and
  /// pose, also where these are found or change afterwards. Returns its index.
  int AddRepeat(TimeNs time_ns);

  /// Records how the scale of a segment came about.
  void SetScale(int segment, const SegmentScale& scale);

  FrameOutcome& outcome(int frame) { return records_[frame].outcome; }

  /// Records in the outcome of the newest frame how adjustments ended. A recorded failure is kept
  /// if more adjustments end after the last frame.
  void AddAdjustments(const UsedAdjustments& used);
  /// Records that the frame was located in a segment that has a keyframe.
  void SetTracked(const Frame& frame, int segment, const MatchCounts& counts, const Map& map);

  bool IsPosed(int frame) const { return records_[frame].keyframe != kNoId; }
  /// Sets the pose of a frame in a segment that has a keyframe.
  void SetPose(int frame, int segment, const SE3& world_from_camera, const Map& map);
  /// Sets the covariance of a posed frame relative to a keyframe.
  void SetCovariance(int frame, KeyframeId reference, const SE3::Matrix6& covariance);
  /// Adds the newest keyframe of the map. Unless its frame is already posed (in the previous
  /// segment), the frame gets the pose of the keyframe and is marked as a keyframe.
  void AddKeyframe(int frame, KeyframeId keyframe, const Map& map);
  /// Removes a keyframe that was culled since the last change of the map and was neither the first
  /// nor the newest of its segment. Its frames are then expressed relative to the keyframes around
  /// it.
  void RemoveKeyframe(KeyframeId keyframe, const Map& map);
  /// Removes the poses and rotations of all frames, and the keyframes. Frames that were posed get
  /// the reason.
  void DiscardPoses(Reason reason);
  /// Joins two segments of the map and moves the frames of the later one with it.
  void JoinSegments(const SegmentJoin& join, Map& map);
  /// Expresses the rotation of a frame that is not posed relative to an earlier frame. A frame that
  /// is its own reference starts a chain of rotations.
  void SetRotation(int frame, int reference, const SO3& reference_from_camera);

  /// Returns the pose of a posed frame.
  SE3 PoseOf(int frame, const Map& map) const;
  /// Returns the rotation of a frame that is posed or whose chain of rotations ends in a posed
  /// frame or at its start; std::nullopt for any other frame.
  std::optional<SO3> RotationOf(int frame, const Map& map) const;

  /// Returns the result of a frame, with the current pose and rotation from the map.
  FrameResult ResultOf(int frame, const Map& map) const;
  Trajectory ToTrajectory(const Map& map) const;

  std::size_t num_bytes() const {
    return records_.size() * sizeof(Record) + keyframes_.size() * sizeof(Keyframes::value_type);
  }

 private:
  struct Record {
    FrameOutcome outcome;
    int covariance_reference = kNoId;    // Frame that the covariance is relative to.
    std::array<float, 21> covariance{};  // Its Cholesky factor.
    KeyframeId keyframe = kNoId;  // For a posed frame: the last one before it, or the first after.
    int reference = kNoId;        // For a frame of which only the rotation is known.
    SE3 from_camera;              // Relative to `keyframe` or `reference`.
  };
  struct Keyframe {
    int frame = kNoId;
    SE3 from_before;  // Pose of the previous keyframe when they became neighbors.
  };
  using Keyframes = std::map<KeyframeId, Keyframe>;

  std::optional<RelativePose> RelativePoseOf(int frame, const Map& map) const;
  /// Returns the keyframe that a frame of a segment is expressed relative to.
  KeyframeId FindKeyframe(int frame, int segment, const Map& map) const;
  /// Returns the posed frames of a segment with their poses.
  std::map<int, SE3> PosesOf(int segment, const Map& map) const;
  /// Sets `from_before` of a keyframe from the current poses of the map.
  void Join(Keyframes::iterator keyframe, const Map& map);

  std::deque<Record> records_;
  std::vector<SegmentScale> scales_;  // By index of the segment.
  Keyframes keyframes_;
};

}  // namespace corvo
