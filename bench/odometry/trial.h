// SPDX-License-Identifier: MIT
#pragma once

#include "bench/odometry/recording.h"
#include "vo/core/options.h"

namespace corvo::bench {

/// The accuracy and cost of odometry on a recording. Lengths are in the ground truth's unit;
/// unknown figures are NaN.
struct TrialResult {
  int frames = 0;
  double posed_share = 0;     ///< Share of frames with a pose, 0 to 1.
  double rotation_share = 0;  ///< Share of frames with a pose or a rotation, 0 to 1.
  int segments = 0;
  int losses = 0;       ///< Number of frames without a pose that follow one with a pose.
  double ate = 0;       ///< RMSE after one Sim3 alignment.
  double live_ate = 0;  ///< The same for the poses that Process() returned.
  double t_rel_percent = 0;
  double r_rel_deg_per_100m = 0;
  double rpe = 0;           ///< Translation error from frame to frame, RMSE.
  double rotation_deg = 0;  ///< Error of the rotation over 1 s, RMSE.
  double scale_drift = 0;   ///< Ratio of the scale in the last third to that in the first third.
  double scale_percent_per_km = 0;
  double wall_ms = 0;         ///< Mean wall time of Process() per frame.
  double processor_ms = 0;    ///< Mean processor time of all threads per frame.
  double peak_memory_mb = 0;  ///< Peak memory of the process; set by the parent process.
};

/// Runs odometry on a recording and evaluates the trajectory, which is refined before if `refine`.
TrialResult RunTrial(const Recording& recording, const OdometryOptions& options,
                     bool refine = false);

}  // namespace corvo::bench
