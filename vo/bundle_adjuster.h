#pragma once

#include <vector>

#include "vo/camera.h"
#include "vo/conventions.h"
#include "vo/keypoint_noise.h"
#include "vo/map.h"
#include "vo/options.h"

namespace corvo {

/// Which keyframes a windowed adjustment moves and which it holds.
struct AdjustmentWindow {
  std::vector<KeyframeId> moving;  ///< Ascending.
  std::vector<KeyframeId>
      held;  ///< See landmarks of the moving ones; hold pose and scale. Ascending.
  std::vector<LandmarkId> landmarks;  ///< Seen by a moving keyframe. Ascending.
};

/// The newest keyframe and the keyframes most covisible with it move; others that see enough of
/// their landmarks are held. Those that see only a few are left out: a handful of wrong matches
/// would decide the scale of the whole window.
AdjustmentWindow SelectWindow(const Map& map, KeyframeId newest,
                              const BundleAdjusterOptions& options);

/// What an adjustment did.
struct AdjustmentResult {
  bool usable = false;      ///< False: the solver failed and the map is as it was.
  double initial_cost = 0;  ///< Half the sum of robust squared errors, in units of sigma².
  double final_cost = 0;
  int num_observations = 0;
  std::vector<Observation> outliers;  ///< Observations removed from the map.
};

/// Minimises the robust reprojection error over the window's moving keyframes and its landmarks
/// (Huber, Schur elimination), removes the observations over the 95% quantile, and minimises again
/// without them. The gauge: held keyframes; if there are fewer than two, the oldest keyframe of the
/// window stays where it is and the farthest keeps its distance from it. Writes to the map only a
/// usable solution. Deterministic.
AdjustmentResult AdjustBundle(Map& map, const AdjustmentWindow& window, const Camera& camera,
                              const KeypointNoise& noise, const BundleAdjusterOptions& options);

}  // namespace corvo
