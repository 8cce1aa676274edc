#include "vo/trajectory.h"

namespace corvo {

PoseSequence Trajectory::PosedFrames() const {
  PoseSequence poses;
  for (const FrameResult& frame : frames) {
    if (frame.world_from_camera) poses.push_back({frame.time_ns, *frame.world_from_camera});
  }
  return poses;
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
