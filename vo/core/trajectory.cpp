// SPDX-License-Identifier: MIT
#include "vo/core/trajectory.h"

#include <array>
#include <cstddef>
#include <map>

#include "orb/error.h"

namespace corvo {

void CheckPose(const std::string& name, const SE3& pose) {
  constexpr std::array<const char*, 3> kAxes = {" x", " y", " z"};
  for (int i = 0; i < 3; ++i) {
    CheckRange(name + ":" + kAxes[i], pose.translation()[i], -kMaxCoordinate, kMaxCoordinate);
  }
  if (pose.rotation().quaternion().coeffs().allFinite()) return;
  throw Error(name + ": the rotation is not finite");
}

PoseSequence Trajectory::PosedFrames() const {
  PoseSequence poses;
  for (const FrameResult& frame : frames) {
    if (frame.world_from_camera) poses.push_back({frame.time_ns, *frame.world_from_camera});
  }
  return poses;
}

PoseSequence Trajectory::Rotations() const {
  PoseSequence rotations;
  for (const FrameResult& frame : frames) {
    if (!frame.world_from_camera_rotation) continue;
    rotations.push_back(
        {frame.time_ns, SE3(*frame.world_from_camera_rotation, Eigen::Vector3d::Zero())});
  }
  return rotations;
}

double Trajectory::PosedShare() const {
  if (frames.empty()) return 0;
  return static_cast<double>(PosedFrames().size()) / static_cast<double>(frames.size());
}

std::vector<Segment> Trajectory::Segments() const {
  std::map<int, Segment> by_index;
  for (const FrameResult& frame : frames) {
    if (!frame.world_from_camera) continue;
    Segment& segment = by_index[frame.segment];
    if (segment.num_poses == 0) segment.first_frame = frame.index;
    segment.last_frame = frame.index;
    ++segment.num_poses;
  }
  std::vector<Segment> segments;
  for (auto& [index, segment] : by_index) {
    segment.index = index;
    const auto position = static_cast<std::size_t>(index);
    if (index >= 0 && position < scales.size()) segment.scale = scales[position];
    segments.push_back(segment);
  }
  return segments;
}

void UpdateRelativePoses(Trajectory& trajectory) {
  for (FrameResult& frame : trajectory.frames) {
    if (!frame.relative_pose) continue;
    const FrameResult& reference = trajectory.frames[frame.relative_pose->reference];
    if (!frame.world_from_camera || !reference.world_from_camera ||
        reference.segment != frame.segment) {
      frame.relative_pose.reset();
      continue;
    }
    frame.relative_pose->reference_from_camera =
        reference.world_from_camera->Inverse() * *frame.world_from_camera;
  }
}

}  // namespace corvo
