// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "vo/camera/camera.h"
#include "vo/core/conventions.h"
#include "vo/map/map.h"
#include "vo/map/observation.h"
#include "vo/optimization/adjustment_window.h"

namespace corvo {

/// A copy of the poses, points and observations of one segment, in the frame of its oldest view. An
/// adjustment works on the copy independently of changes to the map.
struct Bundle {
  struct View {
    KeyframeId keyframe = kNoId;  ///< kNoId for a frame that is not a keyframe.
    bool is_fixed = false;
    SE3::Data local_from_camera;

    SE3 Pose() const { return SE3::FromData(local_from_camera.data()); }
  };
  struct Point {
    LandmarkId landmark = kNoId;
    Eigen::Vector3d in_local;
  };
  /// An observation of a point in a view.
  struct Observation : corvo::Observation {
    int view = 0;   ///< Index in `views`.
    int point = 0;  ///< Index in `points`.
    bool is_inlier = true;
  };

  SE3 world_from_local;
  std::vector<View> views;                ///< Keyframes in ascending order, then other frames.
  std::vector<Point> points;              ///< In ascending order of landmarks.
  std::vector<Observation> observations;  ///< Grouped by point, in their order.
};

/// Returns camera_from_local of each view.
std::vector<SE3> CamerasFromLocal(const Bundle& bundle);

/// Returns the index of a landmark's point, or kNoId if the bundle has none.
int FindPoint(const Bundle& bundle, LandmarkId landmark);

/// Returns the offsets of the points' observations: those of point p have the indices offsets[p] to
/// offsets[p + 1] - 1. There is one offset more than there are points.
std::vector<int> ObservationOffsets(const Bundle& bundle);

/// Returns where a camera sees the point of each observation, if it does.
std::vector<std::optional<Eigen::Vector2d>> PredictPixels(const Camera& camera,
                                                          const Bundle& bundle);

/// Calls `visit` with every observation of a bundle and its SquaredError.
void VisitErrors(const Camera& camera, Bundle& bundle,
                 const std::function<void(Bundle::Observation&, double)>& visit);

/// Returns a copy of a window of the map.
Bundle CopyBundle(const Map& map, const AdjustmentWindow& window);

/// Writes the poses and points of a bundle to the map and removes the observations that are
/// outliers. Keyframes and landmarks that were removed from the map in the meantime are skipped.
/// The correction is propagated to what the bundle does not contain: newer keyframes of the segment
/// move with the newest free view; a landmark moves with the newest free view that observes it or,
/// if only newer keyframes observe it, with the newest free view of all. The correction of a view
/// is the similarity of its own motion and the median ratio of the depths that it observes.
void WriteBack(const Bundle& bundle, Map& map);

}  // namespace corvo
