// SPDX-License-Identifier: MIT
#include "vo/map/frame_history.h"

#include <algorithm>
#include <iterator>

#include <utility>

#include <fmt/format.h>
#include <Eigen/Cholesky>

#include "orb/error.h"

namespace corvo {
namespace {

using LowerTriangle = std::array<float, 21>;

/// Returns the Cholesky factor of a covariance, so that it is positive definite also after
/// rounding.
LowerTriangle Pack(const SE3::Matrix6& covariance) {
  constexpr double kRounding = 1e-12;
  SE3::Matrix6 regular = covariance;
  regular.diagonal() *= 1 + kRounding;
  const Eigen::LLT<SE3::Matrix6> cholesky(regular);
  LowerTriangle packed{};
  if (cholesky.info() != Eigen::Success) return packed;
  const SE3::Matrix6 lower = cholesky.matrixL();
  int i = 0;
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column <= row; ++column) {
      packed[i++] = static_cast<float>(lower(row, column));
    }
  }
  return packed;
}

SE3::Matrix6 Unpack(const LowerTriangle& packed) {
  SE3::Matrix6 lower = SE3::Matrix6::Zero();
  int i = 0;
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column <= row; ++column) lower(row, column) = packed[i++];
  }
  return lower * lower.transpose();
}

/// Interpolates between the first pose (at a share of 0) and the second (at 1).
SE3 Interpolate(const SE3& first, const SE3& second, double share) {
  return first * (first.Inverse() * second).Power(share);
}

/// Sets `noted` to the status of a later adjustment, unless an earlier one has failed.
void Update(AdjustmentStatus status, AdjustmentStatus& noted) {
  const bool has_failed = noted != AdjustmentStatus::kNone && !IsUsable(noted);
  if (status != AdjustmentStatus::kNone && !has_failed) noted = status;
}

/// The result of a frame that repeats another one. Where only the rotation of that one is known,
/// the camera is known to have stood still.
FrameResult RepeatOf(FrameResult original, const FrameOutcome& repeat) {
  original.index = repeat.index;
  original.time_ns = repeat.time_ns;
  original.repeats = repeat.repeats;
  original.is_keyframe = false;
  original.window_adjustment = repeat.window_adjustment;
  original.camera_adjustment = repeat.camera_adjustment;
  if (original.world_from_camera) {
    original.reason = Reason::kRepeatedImage;
  } else if (original.world_from_camera_rotation) {
    original.state = State::kRotationOnly;
    original.reason = Reason::kLowParallax;
    original.segment = std::max(original.segment, 0);
  }
  return original;
}

}  // namespace

void FrameHistory::CheckNext(TimeNs time_ns) const {
  CheckRange("time of a frame in ns", time_ns, -kMaxTimeNs, kMaxTimeNs);
  if (records_.empty() || time_ns > records_.back().outcome.time_ns) return;
  throw Error(fmt::format("time of frame {} is {} ns; it must be after the frame before, {} ns",
                          size(), time_ns, records_.back().outcome.time_ns));
}

int FrameHistory::Add(TimeNs time_ns) {
  FrameOutcome& outcome = records_.emplace_back().outcome;
  outcome.index = size() - 1;
  outcome.time_ns = time_ns;
  return outcome.index;
}

void FrameHistory::SetFeatures(const Frame& frame) {
  FrameOutcome& outcome = records_[frame.index].outcome;
  outcome.num_features = frame.num_keypoints();
  const auto& keypoints = frame.features.keypoints;
  const auto finest = std::ranges::min_element(keypoints, {}, &orb::Keypoint::octave);
  if (finest != keypoints.end()) outcome.finest_octave = finest->octave;
}

int FrameHistory::AddMissing(TimeNs time_ns, Reason reason) {
  const int index = Add(time_ns);
  records_[index].outcome.reason = reason;
  return index;
}

int FrameHistory::AddRepeat(TimeNs time_ns) {
  const auto with_image =
      std::find_if(records_.rbegin(), records_.rend(),
                   [](const Record& record) { return !IsMissingImage(record.outcome.reason); });
  const FrameOutcome newest = with_image->outcome;
  const int original = newest.repeats == kNoId ? newest.index : newest.repeats;
  const int index = Add(time_ns);
  records_[index].outcome.repeats = original;
  return index;
}

void FrameHistory::SetScale(int segment, const SegmentScale& scale) {
  scales_.resize(std::max(scales_.size(), static_cast<std::size_t>(segment) + 1));
  scales_[segment] = scale;
}

void FrameHistory::AddAdjustments(const UsedAdjustments& used) {
  FrameOutcome& outcome = records_.back().outcome;
  Update(used.window, outcome.window_adjustment);
  Update(used.camera, outcome.camera_adjustment);
}

void FrameHistory::SetTracked(const Frame& frame, int segment, const MatchCounts& counts,
                              const Map& map) {
  FrameOutcome& outcome = records_[frame.index].outcome;
  outcome.state = State::kTracking;
  outcome.reason = Reason::kNone;
  outcome.segment = segment;
  outcome.num_matches = counts.num_matches;
  outcome.num_inliers = counts.num_inliers;
  if (!outcome.is_keyframe) SetPose(frame.index, segment, frame.world_from_camera, map);
}

void FrameHistory::SetPose(int frame, int segment, const SE3& world_from_camera, const Map& map) {
  Record& record = records_[frame];
  record.keyframe = FindKeyframe(frame, segment, map);
  record.from_camera = map.WorldFromKeyframe(record.keyframe).Inverse() * world_from_camera;
}

void FrameHistory::SetCovariance(int frame, KeyframeId reference, const SE3::Matrix6& covariance) {
  if (!covariance.allFinite()) return;
  Record& record = records_[frame];
  record.covariance_reference = keyframes_.at(reference).frame;
  record.covariance = Pack(covariance);
}

KeyframeId FrameHistory::FindKeyframe(int frame, int segment, const Map& map) const {
  KeyframeId found = kNoId;
  for (auto keyframe = keyframes_.rbegin(); keyframe != keyframes_.rend(); ++keyframe) {
    if (map.SegmentOf(keyframe->first) != segment) continue;
    found = keyframe->first;
    if (keyframe->second.frame <= frame) break;
  }
  return found;
}

void FrameHistory::AddKeyframe(int frame, KeyframeId keyframe, const Map& map) {
  Join(keyframes_.insert({keyframe, {frame, SE3()}}).first, map);
  if (IsPosed(frame)) return;
  records_[frame].outcome.is_keyframe = true;
  records_[frame].keyframe = keyframe;
  records_[frame].from_camera = SE3();
}

void FrameHistory::Join(Keyframes::iterator keyframe, const Map& map) {
  if (keyframe == keyframes_.begin()) return;
  keyframe->second.from_before = map.WorldFromKeyframe(keyframe->first).Inverse() *
                                 map.WorldFromKeyframe(std::prev(keyframe)->first);
}

void FrameHistory::RemoveKeyframe(KeyframeId keyframe, const Map& map) {
  const auto removed = keyframes_.find(keyframe);
  const auto before = std::prev(removed);
  const auto after = std::next(removed);
  const SE3 before_from_world = map.WorldFromKeyframe(before->first).Inverse();
  // Two keyframes of joined segments may be of the same frame.
  for (int frame = before->second.frame + 1; frame <= after->second.frame; ++frame) {
    Record& record = records_[frame];
    if (record.keyframe != before->first && record.keyframe != keyframe) continue;
    record.from_camera = before_from_world * PoseOf(frame, map);
    record.keyframe = before->first;
  }
  keyframes_.erase(removed);
  Join(after, map);
}

void FrameHistory::DiscardPoses(Reason reason) {
  for (Record& record : records_) {
    FrameOutcome& outcome = record.outcome;
    if (record.keyframe != kNoId) outcome.reason = reason;
    outcome.state = State::kInitializing;
    outcome.is_keyframe = false;
    outcome.segment = kNoId;
    record.keyframe = kNoId;
    record.reference = kNoId;
    record.covariance_reference = kNoId;
  }
  keyframes_.clear();
  scales_.clear();
}

void FrameHistory::JoinSegments(const SegmentJoin& join, Map& map) {
  std::map<int, SE3> poses = PosesOf(join.later, map);
  for (auto& [frame, pose] : poses) pose = TransformPose(join.earlier_from_later, pose);
  poses.merge(PosesOf(join.earlier, map));
  map.JoinSegments(join);
  for (Record& record : records_) {
    if (record.outcome.segment != join.later) continue;
    record.outcome.segment = join.earlier;
    record.covariance =
        Pack(ScaleCovariance(join.earlier_from_later.scale(), Unpack(record.covariance)));
  }
  // The neighbors of keyframes and frames have changed.
  for (auto keyframe = keyframes_.begin(); keyframe != keyframes_.end(); ++keyframe) {
    if (map.SegmentOf(keyframe->first) == join.earlier) Join(keyframe, map);
  }
  for (const auto& [frame, pose] : poses) {
    if (keyframes_.at(records_[frame].keyframe).frame == frame &&
        records_[frame].outcome.is_keyframe) {
      continue;
    }
    SetPose(frame, join.earlier, pose, map);
  }
}

std::map<int, SE3> FrameHistory::PosesOf(int segment, const Map& map) const {
  std::map<int, SE3> poses;
  for (int frame = 0; frame < size(); ++frame) {
    if (!IsPosed(frame) || map.SegmentOf(records_[frame].keyframe) != segment) continue;
    poses[frame] = PoseOf(frame, map);
  }
  return poses;
}

void FrameHistory::SetRotation(int frame, int reference, const SO3& reference_from_camera) {
  records_[frame].reference = reference;
  records_[frame].from_camera = SE3(reference_from_camera, Eigen::Vector3d::Zero());
}

SE3 FrameHistory::PoseOf(int frame, const Map& map) const {
  const Record& record = records_[frame];
  const SE3 by_first = map.WorldFromKeyframe(record.keyframe) * record.from_camera;
  const auto first = keyframes_.find(record.keyframe);
  const auto second = std::next(first);
  if (second == keyframes_.end() || frame <= first->second.frame) return by_first;
  if (map.SegmentOf(second->first) != map.SegmentOf(first->first)) return by_first;
  const SE3 second_from_camera = second->second.from_before * record.from_camera;
  const SE3 by_second = map.WorldFromKeyframe(second->first) * second_from_camera;
  const double to_first = record.from_camera.translation().norm();
  const double to_second = second_from_camera.translation().norm();
  if (!(to_first > 0)) return by_first;
  return Interpolate(by_first, by_second, to_first / (to_first + to_second));
}

std::optional<SO3> FrameHistory::RotationOf(int frame, const Map& map) const {
  SO3 ancestor_from_camera;
  for (int ancestor = frame;;) {
    const Record& record = records_[ancestor];
    if (IsPosed(ancestor)) return PoseOf(ancestor, map).rotation() * ancestor_from_camera;
    if (record.reference == kNoId) return std::nullopt;
    ancestor_from_camera = record.from_camera.rotation() * ancestor_from_camera;
    if (record.reference == ancestor) return ancestor_from_camera;
    ancestor = record.reference;
  }
}

FrameResult FrameHistory::ResultOf(int frame, const Map& map) const {
  const FrameOutcome& outcome = records_[frame].outcome;
  if (outcome.repeats != kNoId) {
    FrameResult original = ResultOf(outcome.repeats, map);
    original.world_from_camera_rotation = RotationOf(outcome.repeats, map);
    return RepeatOf(std::move(original), outcome);
  }
  FrameResult result{outcome, {}, {}, {}};
  if (IsPosed(frame)) result.world_from_camera = PoseOf(frame, map);
  result.relative_pose = RelativePoseOf(frame, map);
  if (IsPosed(frame) || result.state == State::kRotationOnly) {
    result.world_from_camera_rotation = RotationOf(frame, map);
  }
  return result;
}

std::optional<RelativePose> FrameHistory::RelativePoseOf(int frame, const Map& map) const {
  const Record& record = records_[frame];
  const int reference = record.covariance_reference;
  if (!IsPosed(frame) || reference == kNoId || !IsPosed(reference)) return std::nullopt;
  if (records_[reference].outcome.segment != record.outcome.segment) return std::nullopt;
  const SE3 reference_from_camera = PoseOf(reference, map).Inverse() * PoseOf(frame, map);
  return RelativePose{reference, reference_from_camera, Unpack(record.covariance)};
}

Trajectory FrameHistory::ToTrajectory(const Map& map) const {
  Trajectory trajectory{{}, scales_};
  for (int frame = 0; frame < size(); ++frame) trajectory.frames.push_back(ResultOf(frame, map));
  return trajectory;
}

}  // namespace corvo
