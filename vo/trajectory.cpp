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

}  // namespace corvo
