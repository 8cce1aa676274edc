#pragma once

#include <memory>
#include <vector>

#include "apps/frame_tables.h"
#include "apps/landmark_spool.h"
#include "vo/odometry.h"

namespace corvo {

/// What a run leaves behind, before anything is written.
struct RunRecord {
  Odometry odometry;
  std::unique_ptr<LandmarkSpool> finished;  ///< Landmarks that have left the odometry's map.
  Trajectory trajectory;  ///< As known after the last picture; in metres where that was asked for.
  std::vector<FrameTiming> timings;
  double elapsed_s = 0;
  bool is_interrupted = false;  ///< Ended by Ctrl-C, before the last picture.
};

}  // namespace corvo
