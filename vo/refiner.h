#pragma once

#include <functional>
#include <vector>

#include "vo/frame_sightings.h"
#include "vo/full_adjustment.h"
#include "vo/map.h"
#include "vo/odometry.h"
#include "vo/trajectory.h"

namespace corvo {

struct RefinerOptions {
  int max_points = 400;  ///< Of a keyframe, about: see ThinPoints. They bound time and memory.
  FullAdjustmentOptions adjustment;
};

/// A sequence adjusted as a whole.
struct Refinement {
  FullAdjustment adjustment;  ///< kLowered: the rest is refined. Otherwise it is as it was.
  Trajectory trajectory;
  std::vector<FinishedLandmark> landmarks;  ///< That were adjusted, inliers of two keyframes.
  int num_keyframes = 0;                    ///< That were adjusted.
  int num_placed = 0;                       ///< Other posed frames that were placed again ...
  int num_moved = 0;                        ///< ... or moved with the keyframe before.
};

/// Adjusts all keyframes and landmarks of a finished sequence together, see AdjustFully, each
/// segment with a gauge of its own and all with one camera: what was given to the odometry, as sure
/// as its options say, from what it estimated; a camera that the odometry takes as exact stays.
/// Then every other posed frame is placed again, see OptimizePose; it moves with the keyframe
/// before it where too few landmarks agree. Frames without a pose stay as they are. `sightings`
/// gives what the odometry gave to its sink. `progress` gets the share done, 0 to 1. Deterministic.
Refinement Refine(const Odometry& odometry, const SightingsSource& sightings,
                  const RefinerOptions& options = {},
                  const std::function<void(double)>& progress = {});

/// How sure an odometry's camera is: nothing is free where it is taken as it was given.
CameraPrior PriorOf(const Odometry& odometry);

}  // namespace corvo
