// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

namespace corvo {

/// Why a bundle adjustment ended.
enum class AdjustmentStatus : std::uint8_t {
  kNone,            ///< There was none.
  kConverged,       ///< The cost changes no more.
  kIterationLimit,  ///< The iterations are used up; the cost is lower than before.
  kNoObservations,  ///< There is nothing to adjust.
  kSolverFailed,    ///< No step lowers the cost, or the numbers are not finite.
  kInvalidCamera,   ///< The solution is not a camera.
  kNotImproved,     ///< The robust cost over all observations would be higher than before.
  kCanceled,        ///< It was asked to stop.
};

/// "none", "converged", "iteration_limit", ...
std::string_view ToString(AdjustmentStatus status);

/// Whether the adjusted poses, points and camera are used. Otherwise everything is as it was.
inline bool IsUsable(AdjustmentStatus status) {
  return status == AdjustmentStatus::kConverged || status == AdjustmentStatus::kIterationLimit;
}

/// How the adjustments ended whose results were used; kNone where none was due.
struct UsedAdjustments {
  AdjustmentStatus window = AdjustmentStatus::kNone;
  AdjustmentStatus camera = AdjustmentStatus::kNone;

  bool any() const {
    return window != AdjustmentStatus::kNone || camera != AdjustmentStatus::kNone;
  }
};

}  // namespace corvo
