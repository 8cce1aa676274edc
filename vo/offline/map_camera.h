// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vo/camera/camera_prior.h"
#include "vo/core/conventions.h"
#include "vo/map/map.h"
#include "vo/optimization/bundle_adjuster.h"

namespace corvo {

/// Consecutive active keyframes of one segment.
using KeyframeGroup = std::vector<KeyframeId>;

/// Options of SplitKeyframes() and AdjustMapCamera().
struct MapCameraOptions {
  int min_keyframes = 5;            ///< Smallest group, as for the estimate while tracking.
  int points_per_keyframe = 200;    ///< Points of each keyframe, longest tracks first.
  int max_points = 4000;            ///< Points of an adjustment, about.
  int num_rounds = 2;               ///< Outliers are excluded before the second.
  int max_iterations = 20;          ///< Largest number of iterations of a round.
  double max_error_sigmas = 10;     ///< Observations with larger residuals are left out.
  double information_factor = 3.5;  ///< As in CalibrationOptions.
};

/// Splits the active keyframes of every segment into consecutive groups of about equal size, about
/// `num_groups` in total. Groups of fewer than `min_keyframes` keyframes are left out.
std::vector<KeyframeGroup> SplitKeyframes(const Map& map, int num_groups,
                                          const MapCameraOptions& options = {});

/// Adjusts copies of groups of keyframes, their landmarks and the camera, starting from the map's
/// camera. Keyframes outside the groups have no influence. The map does not change. Throws
/// corvo::Error if the prior is invalid.
AdjustmentSummary AdjustMapCamera(const Map& map, const std::vector<KeyframeGroup>& groups,
                                  const CameraPrior& prior, const MapCameraOptions& options = {});

}  // namespace corvo
