// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "bench/odometry/recording.h"
#include "vo/odometry.h"

namespace corvo::bench {

/// What odometry holds after so many frames, and what the frames cost.
struct Holding {
  int frames = 0;
  int posed_frames = 0;
  int keyframes = 0;       ///< Ever made.
  int kept_keyframes = 0;  ///< Still in the working set.
  int landmarks = 0;       ///< Likewise.
  MemoryUse memory;
  std::size_t spooled_bytes = 0;   ///< Of finished landmarks, in a file.
  std::size_t heap_bytes = 0;      ///< In use by the process, beyond what was before the start.
  std::size_t resident_bytes = 0;  ///< Of the process, likewise; free memory is given back first.
  double processor_ms = 0;         ///< Of Process, a frame; mean since the holding before.
};

/// Calls `report` after each of the numbers of frames, which ascend.
void MeasureHoldings(const Recording& recording, const OdometryOptions& options,
                     const std::vector<int>& after_frames,
                     const std::function<void(const Holding&)>& report);

/// Head and line of a Markdown table.
std::string HoldingHead();
std::string HoldingLine(const std::string& title, const Holding& holding);

}  // namespace corvo::bench
