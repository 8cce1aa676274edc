#pragma once

#include "vo/camera/camera.h"
#include "vo/core/options.h"
#include "vo/map/map.h"
#include "vo/optimization/bundle.h"

namespace corvo {

/// The newest keyframe and the keyframes most covisible with it move; others that see enough of
/// their landmarks are fixed. Those that see only a few are left out: a handful of wrong matches
/// would decide the scale of the whole window.
AdjustmentWindow SelectWindow(const Map& map, KeyframeId newest,
                              const BundleAdjusterOptions& options);

/// The newest keyframes of a segment, up to `newest`, move; others are fixed as by SelectWindow.
AdjustmentWindow SelectNewestKeyframes(const Map& map, KeyframeId newest, int max_keyframes,
                                       const BundleAdjusterOptions& options);

/// What an adjustment did.
struct AdjustmentResult {
  bool usable = false;      ///< False: the solver failed and the bundle is as it was.
  double initial_cost = 0;  ///< Half the sum of robust squared errors, in units of sigma².
  double final_cost = 0;
};

/// Minimizes the robust reprojection error over the views that are not fixed and the points (Huber,
/// Schur elimination), then marks as outliers the observations over the 95% quantile. The gauge:
/// fixed views; if there are fewer than two, the oldest view stays where it is and the farthest
/// keeps its distance from it. Deterministic.
AdjustmentResult AdjustBundle(const Camera& camera, const BundleAdjusterOptions& options,
                              Bundle& bundle);

}  // namespace corvo
