// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

#include "vo/core/trajectory.h"

namespace corvo {

/// How a run ended. The values are the exit codes of `corvo run`; 1 stands for bad input.
enum class Outcome {
  kDone = 0,
  kNeverInitialized = 2,  ///< No frame is posed.
  kLost = 3,              ///< Lost after initialization: a gap, or poses in several segments.
};

Outcome JudgeOutcome(const Trajectory& trajectory);
std::string_view ToString(Outcome outcome);

/// Distinct segments among the posed frames.
int CountPosedSegments(const Trajectory& trajectory);

int CountPosedFrames(const Trajectory& trajectory);

}  // namespace corvo
