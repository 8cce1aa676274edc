#pragma once

#include <vector>

#include "vo/core/trajectory.h"
#include "vo/map/map.h"
#include "vo/map/observation_recorder.h"
#include "vo/odometry.h"
#include "vo/offline/sequence_record.h"
#include "vo/optimization/full_adjustment.h"

namespace corvo {

struct RefinerOptions {
  SequenceOptions sequence;
  /// Errors are a fraction of their sigma, but alike along a track (docs/calibration.md).
  FullAdjustmentOptions adjustment{.information_factor = 4.5, .huber_sigmas = 0.37};
};

/// A sequence adjusted as a whole.
struct Refinement {
  FullAdjustment adjustment;  ///< kImproved: the rest is refined. Otherwise it is as it was.
  Trajectory trajectory;
  std::vector<MarginalizedLandmark> landmarks;  ///< Inliers of at least two adjusted frames.
  int num_adjusted = 0;                         ///< Keyframes, and frames between them.
  int num_placed = 0;                           ///< Other posed frames that were placed again ...
  int num_moved = 0;                            ///< ... or moved with the adjusted frame before.
};

/// Adjusts all keyframes, some of the frames between them, and the landmarks of a finished sequence
/// together, see AdjustFully: each segment with a gauge of its own and all with one camera, which
/// is what was given to the odometry, as sure as its options say, from what it estimated. A camera
/// that the odometry takes as exact stays. Then every other posed frame is placed again, see
/// OptimizePose; where too few landmarks agree it moves with the adjusted frame before it. Frames
/// without a pose stay as they are. The size of the adjustment grows with the number of keyframes
/// alone. `observations` gives what the odometry gave to its sink, as often as it is asked.
/// Deterministic.
Refinement Refine(const Odometry& odometry, const ObservationSource& observations,
                  const RefinerOptions& options = {}, const AdjustmentProgress& progress = {});

/// How sure an odometry's camera is: nothing is free where it is taken as it was given.
CameraPrior PriorOf(const Odometry& odometry);

}  // namespace corvo
