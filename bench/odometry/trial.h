// SPDX-License-Identifier: MIT
#pragma once

#include "bench/odometry/recording.h"
#include "vo/core/options.h"

namespace corvo::bench {

/// What odometry made of a recording. Lengths are in the truth's unit; NaN is what cannot be said.
struct TrialResult {
  int frames = 0;
  double posed_share = 0;     ///< Of the frames, 0 to 1.
  double rotation_share = 0;  ///< Of the frames: those with a pose or a rotation.
  int segments = 0;
  int losses = 0;  ///< How often a frame with a pose was followed by one without.
  double ate = 0;  ///< Root mean square after one Sim3.
  double t_rel_percent = 0;
  double r_rel_deg_per_100m = 0;
  double rpe = 0;           ///< Translation from frame to frame, root mean square.
  double rotation_deg = 0;  ///< Error of the rotation over 1 s, root mean square.
  double scale_drift = 0;   ///< Estimated step length, last third over first third.
  double scale_percent_per_km = 0;
  double wall_ms = 0;         ///< A frame, mean; of Process alone.
  double processor_ms = 0;    ///< The same, of all threads.
  double peak_memory_mb = 0;  ///< Of the process; set by who started it.
};

/// Of the refined trajectory, if that is asked for.
TrialResult RunTrial(const Recording& recording, const OdometryOptions& options,
                     bool refine = false);

}  // namespace corvo::bench
