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
  /// Errors are a fraction of their sigma, but alike along a track (docs/calibration.md).
  AdjustmentOptions adjustment{.num_rounds = 2, .huber_sigmas = 0.37, .information_factor = 4.5};
};

/// A sequence adjusted as a whole.
struct Refinement {
  AdjustmentSummary adjustment;  ///< Unless it is usable, the rest is as it was.
  Trajectory trajectory;
  std::vector<MarginalizedLandmark> landmarks;  ///< Inliers of at least two adjusted frames.
  int num_adjusted = 0;                         ///< Keyframes, and frames between them.
  int num_placed = 0;                           ///< Other posed frames that were located again ...
  int num_moved = 0;  ///< ... or moved with the adjusted frame before them.
};

/// Global bundle adjustment of a finished sequence: all keyframes, some of the frames between them,
/// and the landmarks are adjusted together, each segment with a gauge of its own and all with one
/// camera, which is what was given to the odometry, as certain as its options say, from what it
/// estimated. A camera that the odometry takes as exact stays. Then every other posed frame is
/// located again, see OptimizePose; where too few landmarks agree it moves with the adjusted frame
/// before it. Frames without a pose stay as they are. The size of the adjustment grows with the
/// number of keyframes alone. `log` has recorded the odometry from its first image on.
/// Deterministic.
Refinement Refine(const Odometry& odometry, const ObservationLog& log,
                  const RefinerOptions& options = {}, const AdjustmentProgress& progress = {});

/// How certain an odometry's camera is: nothing is free where it is taken as it was given.
CameraPrior PriorOf(const Odometry& odometry);

}  // namespace corvo
