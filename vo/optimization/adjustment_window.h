// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vo/core/conventions.h"
#include "vo/core/options.h"
#include "vo/map/map.h"

namespace corvo {

/// The free and the fixed keyframes of a windowed adjustment, and its landmarks.
struct AdjustmentWindow {
  std::vector<KeyframeId> free;  ///< In ascending order.
  /// Keyframes that share landmarks with free ones and fix pose and scale. In ascending order.
  std::vector<KeyframeId> fixed;
  /// Landmarks observed by a free keyframe. In ascending order.
  std::vector<LandmarkId> landmarks;
};

/// Returns a window in which the newest keyframe and the keyframes most covisible with it are free.
/// Other keyframes that observe enough of their landmarks are fixed; those that observe only a few
/// are left out, because a handful of wrong matches would determine the scale of the whole window.
AdjustmentWindow SelectWindow(const Map& map, KeyframeId newest,
                              const BundleAdjusterOptions& options);

/// Returns a window in which the newest keyframes of the segment of `newest` are free, at most
/// `max_keyframes`. Other keyframes are fixed as in SelectWindow().
AdjustmentWindow SelectNewestKeyframes(const Map& map, KeyframeId newest, int max_keyframes,
                                       const BundleAdjusterOptions& options);

}  // namespace corvo
