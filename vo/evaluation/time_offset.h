// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "vo/core/conventions.h"
#include "vo/core/trajectory.h"

namespace corvo {

/// A constant offset between the clocks of an estimate and its ground truth.
struct TimeOffset {
  TimeNs offset_ns = 0;  ///< Time of the ground truth minus time of the estimate.
  /// ATE with this offset, after alignment with scale, unit of the ground truth.
  double rmse = 0;
  /// ATE of the same poses without an offset; std::nullopt if too few of them then have ground
  /// truth.
  std::optional<double> rmse_without;
};

/// Returns the offset that an estimate is suspected to have, or std::nullopt. An offset is
/// suspected if the ATE with it is below half of that without it, or if the times barely overlap
/// without it, and if the aligned estimate then fits the ground truth within a tenth of its extent.
/// Offsets of which at least 80% of the shorter trajectory overlap are searched from coarse to
/// fine, from a quarter of a frame to 5 s if the times overlap. Trajectories that fit with any
/// offset, such as straight ones, have none. All poses must be finite, see CheckPose().
/// Deterministic.
std::optional<TimeOffset> FindTimeOffset(const PoseSequence& estimate, const PoseSequence& truth);

/// Returns the poses with `offset_ns` added to their times. Throws corvo::Error if a time is then
/// out of range (kMaxTimeNs).
PoseSequence ShiftTimes(TimeNs offset_ns, PoseSequence poses);

}  // namespace corvo
