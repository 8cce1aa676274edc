// SPDX-License-Identifier: MIT
#include "vo/core/adjustment_status.h"

namespace corvo {

std::string_view ToString(AdjustmentStatus status) {
  switch (status) {
    case AdjustmentStatus::kNone:
      return "none";
    case AdjustmentStatus::kConverged:
      return "converged";
    case AdjustmentStatus::kIterationLimit:
      return "iteration_limit";
    case AdjustmentStatus::kNoObservations:
      return "no_observations";
    case AdjustmentStatus::kSolverFailed:
      return "solver_failed";
    case AdjustmentStatus::kInvalidCamera:
      return "invalid_camera";
    case AdjustmentStatus::kNotImproved:
      return "not_improved";
    case AdjustmentStatus::kCanceled:
      return "canceled";
  }
  return "unknown";
}

}  // namespace corvo
