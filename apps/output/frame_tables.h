// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "vo/core/trajectory.h"
#include "vo/odometry.h"

namespace corvo {

/// The wall times of one frame, ms.
struct FrameTiming {
  double read_ms = 0;  ///< Reading and decoding the image.
  StageTimes stages;
  double total_ms = 0;  ///< The whole call of Odometry::Process().
};

/// Returns CSV with a header and one row per input frame. Timestamps are seconds with nine
/// decimals, `segment` is -1 before the first segment, `posed` is 0 or 1, `parallax` is in degrees.
std::string FrameTable(const Trajectory& trajectory);

/// Returns CSV with a header and one row per input frame.
std::string TimingTable(const std::vector<FrameTiming>& timings);

}  // namespace corvo
