// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "vo/core/trajectory.h"

namespace corvo {

/// The outcome of a run. The values are the exit codes of `corvo run`, in which 1 is invalid input.
enum class Outcome {
  kDone = 0,
  kNeverInitialized = 2,  ///< No frame has a pose.
  /// Lost after initialization: a gap, or poses in several segments. Missing images are no gap.
  kLost = 3,
};

Outcome JudgeOutcome(const Trajectory& trajectory);
std::string_view ToString(Outcome outcome);

/// Returns the number of distinct segments among the frames with a pose.
int CountPosedSegments(const Trajectory& trajectory);

int CountPosedFrames(const Trajectory& trajectory);

}  // namespace corvo
