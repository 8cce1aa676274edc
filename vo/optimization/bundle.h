// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <vector>

#include "vo/camera/camera.h"
#include "vo/core/conventions.h"
#include "vo/map/map.h"
#include "vo/map/observation.h"
#include "vo/optimization/adjustment_window.h"

namespace corvo {

/// Poses, points and observations of one segment, in the frame of its oldest view: a copy on which
/// an adjustment works, whatever happens to the map meanwhile.
struct Bundle {
  struct View {
    KeyframeId keyframe = kNoId;
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
  std::vector<View> views;                ///< In ascending order of keyframes.
  std::vector<Point> points;              ///< In ascending order of landmarks.
  std::vector<Observation> observations;  ///< Point by point.
};

/// camera_from_local of each view.
std::vector<SE3> CamerasFromLocal(const Bundle& bundle);

/// The observations of point p are those from [p] to [p + 1] - 1: one entry more than there are
/// points.
std::vector<int> ObservationOffsets(const Bundle& bundle);

/// Calls `visit` with every observation of a bundle and its SquaredError.
void VisitErrors(const Camera& camera, Bundle& bundle,
                 const std::function<void(Bundle::Observation&, double)>& visit);

/// A copy of a window of the map.
Bundle CopyBundle(const Map& map, const AdjustmentWindow& window);

/// Gives the map the poses and positions of a bundle and removes the observations that are
/// outliers. Keyframes and landmarks that have left meanwhile stay as they are. What the bundle
/// leaves out is corrected, too: newer keyframes of its segment move with its newest free view, a
/// landmark with the newest free view that observes it or, if only newer keyframes do, with the
/// newest of all. A view's correction is the similarity of its own motion and the median ratio of
/// the depths that it observes.
void WriteBack(const Bundle& bundle, Map& map);

}  // namespace corvo
