// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vo/core/conventions.h"
#include "vo/core/options.h"
#include "vo/map/map.h"

namespace corvo {

/// Which keyframes a windowed adjustment moves and which it keeps fixed.
struct AdjustmentWindow {
  std::vector<KeyframeId> free;  ///< In ascending order.
  /// Keyframes that share landmarks with free ones; they fix pose and scale. In ascending order.
  std::vector<KeyframeId> fixed;
  std::vector<LandmarkId> landmarks;  ///< Observed by a free keyframe. In ascending order.
};

/// The newest keyframe and the keyframes most covisible with it are free; others that observe
/// enough of their landmarks are fixed. Those that observe only a few are left out: a handful of
/// wrong matches would decide the scale of the whole window.
AdjustmentWindow SelectWindow(const Map& map, KeyframeId newest,
                              const BundleAdjusterOptions& options);

/// The newest keyframes of a segment, up to `newest`, are free; others are fixed as in
/// SelectWindow.
AdjustmentWindow SelectNewestKeyframes(const Map& map, KeyframeId newest, int max_keyframes,
                                       const BundleAdjusterOptions& options);

}  // namespace corvo
