// SPDX-License-Identifier: MIT
#include "apps/run/kitti_trajectory.h"

#include <fmt/format.h>

#include "apps/run/outcome.h"

namespace corvo {

std::string WhyNotKitti(const Trajectory& trajectory) {
  const int frames = static_cast<int>(trajectory.frames.size());
  const int posed = CountPosedFrames(trajectory);
  if (posed < frames) {
    return fmt::format("{} of {} frames have no pose", frames - posed, frames);
  }
  const int segments = CountPosedSegments(trajectory);
  return segments > 1 ? fmt::format("the poses are in {} segments", segments) : "";
}

std::vector<SE3> KittiRows(const Trajectory& trajectory) {
  std::vector<SE3> rows;
  for (const FrameResult& frame : trajectory.frames) rows.push_back(*frame.world_from_camera);
  return rows;
}

}  // namespace corvo
