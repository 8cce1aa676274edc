// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vo/core/trajectory.h"
#include "vo/map/map.h"
#include "vo/odometry.h"
#include "vo/offline/observation_log.h"
#include "vo/offline/sequence_record.h"
#include "vo/optimization/bundle_adjuster.h"

namespace corvo {

struct RefinerOptions {
  SequenceOptions sequence;
  /// Residuals are a fraction of their sigma, but correlated along a track (docs/calibration.md).
  AdjustmentOptions adjustment{.num_rounds = 2, .huber_sigmas = 0.37, .information_factor = 4.5};
};

/// The result of adjusting a sequence as a whole.
struct Refinement {
  AdjustmentSummary adjustment;  ///< Unless it is usable, the trajectory is unchanged.
  Trajectory trajectory;
  std::vector<MarginalizedLandmark> landmarks;  ///< Inliers in at least two adjusted frames.
  int num_adjusted = 0;                         ///< Adjusted keyframes and frames between them.
  int num_placed = 0;                           ///< Other posed frames that were located again.
  int num_moved = 0;  ///< Other posed frames that were moved with the adjusted frame before them.
};

/// Runs a global bundle adjustment of a finished sequence. All keyframes, some of the frames
/// between them and the landmarks are adjusted together, each segment with its own gauge and all
/// with one camera, whose prior is that given to the odometry and whose initial value is the
/// odometry's estimate. A camera that the odometry treats as exact is constant. Then every other
/// posed frame is located again, see OptimizePose(); if it has too few inliers, it moves with the
/// adjusted frame before it. Frames without a pose are unchanged. The size of the adjustment grows
/// only with the number of keyframes. The result is deterministic. Throws corvo::Error if an option
/// is out of range, or if `log` did not record this odometry from its first image on.
Refinement Refine(const Odometry& odometry, const ObservationLog& log,
                  const RefinerOptions& options = {}, const AdjustmentProgress& progress = {});

/// Returns the prior of an odometry's camera; no parameter is free if the camera is used as given.
CameraPrior PriorOf(const Odometry& odometry);

}  // namespace corvo
