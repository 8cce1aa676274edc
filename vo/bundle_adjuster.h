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

/// A window's own copy of poses, points and observations, in the frame of its oldest keyframe: what
/// an adjustment works on, whatever happens to the map meanwhile.
struct Bundle {
  struct View {
    KeyframeId keyframe = kNoId;
    bool is_held = false;
    SE3::Data local_from_camera;
  };
  struct Point {
    LandmarkId landmark = kNoId;
    Eigen::Vector3d in_local;
  };
  struct Sighting {
    int view = 0;   ///< Index in `views`.
    int point = 0;  ///< Index in `points`.
    int keypoint = kNoId;
    Eigen::Vector2d pixel;
    double sigma_px = 1;
    bool is_inlier = true;
  };

  SE3 world_from_local;
  std::vector<View> views;          ///< In ascending keyframe.
  std::vector<Point> points;        ///< In ascending landmark.
  std::vector<Sighting> sightings;  ///< Point by point.
};

Bundle CopyBundle(const Map& map, const AdjustmentWindow& window, const KeypointNoise& noise);

/// What an adjustment did.
struct AdjustmentResult {
  bool usable = false;      ///< False: the solver failed and the bundle is as it was.
  double initial_cost = 0;  ///< Half the sum of robust squared errors, in units of sigma².
  double final_cost = 0;
};

/// Minimises the robust reprojection error over the views that are not held and the points (Huber,
/// Schur elimination), then marks as outliers the sightings over the 95% quantile. The gauge: held
/// views; if there are fewer than two, the oldest view stays where it is and the farthest keeps its
/// distance from it. Deterministic.
AdjustmentResult AdjustBundle(const Camera& camera, const BundleAdjusterOptions& options,
                              Bundle& bundle);

/// Gives the map the poses and positions of a bundle and removes the observations that are
/// outliers, which it returns. The map must still have all that was copied.
std::vector<Observation> WriteBack(const Bundle& bundle, Map& map);

}  // namespace corvo
