// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

namespace corvo {

/// The reason why a bundle adjustment ended.
enum class AdjustmentStatus : std::uint8_t {
  kNone,            ///< No adjustment was run.
  kConverged,       ///< The cost no longer changes.
  kIterationLimit,  ///< The iteration limit was reached; the cost decreased.
  kNoObservations,  ///< There is nothing to adjust.
  kSolverFailed,    ///< No step lowers the cost, or the numbers are not finite.
  kInvalidCamera,   ///< The solution is not a valid camera.
  kNotImproved,     ///< The robust cost over all observations would be higher than before.
  kCanceled,        ///< The caller canceled the adjustment.
};

/// Returns "none", "converged", "iteration_limit", ...
std::string_view ToString(AdjustmentStatus status);

/// Returns whether the adjusted poses, points and camera are used. Otherwise they are left
/// unchanged.
inline bool IsUsable(AdjustmentStatus status) {
  return status == AdjustmentStatus::kConverged || status == AdjustmentStatus::kIterationLimit;
}

/// The final statuses of the adjustments whose results were used; kNone if no adjustment was due.
struct UsedAdjustments {
  AdjustmentStatus window = AdjustmentStatus::kNone;
  AdjustmentStatus camera = AdjustmentStatus::kNone;

  bool any() const {
    return window != AdjustmentStatus::kNone || camera != AdjustmentStatus::kNone;
  }
};

}  // namespace corvo
