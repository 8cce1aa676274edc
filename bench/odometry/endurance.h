// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "bench/odometry/recording.h"
#include "vo/odometry.h"

namespace corvo::bench {

/// The memory use of odometry after a number of frames and the processor time of the frames.
struct Holding {
  int frames = 0;
  int posed_frames = 0;
  int keyframes = 0;       ///< Number created so far.
  int kept_keyframes = 0;  ///< Number of active ones, in the working set.
  int landmarks = 0;       ///< Number in the working set.
  MemoryUse memory;
  std::size_t spooled_bytes = 0;   ///< File size of the marginalized landmarks.
  std::size_t heap_bytes = 0;      ///< Heap memory in use minus that before the start.
  std::size_t resident_bytes = 0;  ///< Resident minus that at the start; free memory is released.
  double processor_ms = 0;         ///< Process() per frame, mean since the previous Holding.
};

/// Runs odometry and calls `report` after each number of frames in `after_frames`, which is
/// ascending.
void MeasureHoldings(const Recording& recording, const OdometryOptions& options,
                     const std::vector<int>& after_frames,
                     const std::function<void(const Holding&)>& report);

/// Returns the header of a Markdown table, whose lines HoldingLine() returns.
std::string HoldingHead();
std::string HoldingLine(const std::string& title, const Holding& holding);

}  // namespace corvo::bench
