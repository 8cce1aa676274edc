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

/// Splits the active keyframes of every segment into consecutive groups of about equal size, about
/// `num_groups` in total. Groups of fewer than `min_keyframes` keyframes are left out.
std::vector<KeyframeGroup> SplitKeyframes(const Map& map, int num_groups, int min_keyframes);

/// Adjusts copies of groups of keyframes, their landmarks and the camera, starting from the map's
/// camera, like CalibrationAdjustment() with its default options, but until it converges and twice:
/// outliers are excluded before the second time. Keyframes outside the groups have no influence.
/// The map does not change. `information_factor` is that of AdjustmentOptions; the thresholds of
/// CheckCalibration() and FindCamera() were chosen with the default. Throws corvo::Error if the
/// prior is invalid.
AdjustmentSummary AdjustMapCamera(const Map& map, const std::vector<KeyframeGroup>& groups,
                                  const CameraPrior& prior, double information_factor = 3.5);

}  // namespace corvo
