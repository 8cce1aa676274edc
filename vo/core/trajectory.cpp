// SPDX-License-Identifier: MIT
#include "vo/core/trajectory.h"

namespace corvo {

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

Trajectory Scale(double scale, Trajectory trajectory) {
  for (FrameResult& frame : trajectory.frames) {
    if (!frame.world_from_camera) continue;
    const SE3& pose = *frame.world_from_camera;
    frame.world_from_camera = SE3(pose.rotation(), scale * pose.translation());
  }
  return trajectory;
}

}  // namespace corvo
