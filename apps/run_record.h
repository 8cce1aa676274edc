#pragma once

#include <vector>

#include "apps/frame_tables.h"
#include "vo/odometry.h"

namespace corvo {

/// What a run leaves behind, before anything is written.
struct RunRecord {
  Odometry odometry;
  Trajectory trajectory;  ///< As the odometry knows it after the last picture.
  std::vector<FrameTiming> timings;
  double elapsed_s = 0;
};

}  // namespace corvo
