// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "vo/core/trajectory.h"
#include "vo/odometry.h"

namespace corvo {

/// Wall time of one frame, ms.
struct FrameTiming {
  double read_ms = 0;  ///< Reading and decoding the image.
  StageTimes stages;
  double total_ms = 0;  ///< Odometry::Process as a whole.
};

/// CSV, a header and one row an input frame. Timestamps are seconds with nine decimals, `segment`
/// is -1 before the first, `posed` is 0 or 1, `parallax` is in degrees.
std::string FrameTable(const Trajectory& trajectory);

/// CSV, a header and one row an input frame.
std::string TimingTable(const std::vector<FrameTiming>& timings);

}  // namespace corvo
