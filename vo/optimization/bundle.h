#pragma once

#include <vector>

#include "vo/camera/camera.h"
#include "vo/core/conventions.h"
#include "vo/map/map.h"
#include "vo/map/measurement_model.h"

namespace corvo {

/// Which keyframes a windowed adjustment moves and which it holds.
struct AdjustmentWindow {
  std::vector<KeyframeId> free;  ///< Ascending.
  std::vector<KeyframeId>
      fixed;  ///< See landmarks of the free ones; hold pose and scale. Ascending.
  std::vector<LandmarkId> landmarks;  ///< Seen by a free keyframe. Ascending.
};

/// A window's own copy of poses, points and observations, in the frame of its oldest keyframe: what
/// an adjustment works on, whatever happens to the map meanwhile.
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
  struct Observation {
    int view = 0;   ///< Index in `views`.
    int point = 0;  ///< Index in `points`.
    int keypoint = kNoId;
    Eigen::Vector2d pixel;
    double sigma_px = 1;
    bool is_inlier = true;
  };

  SE3 world_from_local;
  std::vector<View> views;                ///< In ascending keyframe.
  std::vector<Point> points;              ///< In ascending landmark.
  std::vector<Observation> observations;  ///< Point by point.
};

/// camera_from_local of each view.
std::vector<SE3> CamerasFromLocal(const Bundle& bundle);

/// The observations of point p are those from [p] to [p + 1] - 1: one entry more than there are
/// points.
std::vector<int> ObservationOffsets(const Bundle& bundle);

Bundle CopyBundle(const Map& map, const AdjustmentWindow& window);

/// Marks as outliers the observations over a squared error, in units of sigma², and no others.
void MarkOutliers(const Camera& camera, double max_squared_error, Bundle& bundle);

/// Gives the map the poses and positions of a bundle and removes the observations that are
/// outliers, which it returns. Keyframes and landmarks that have left meanwhile stay as they are.
/// What the bundle leaves out goes along: newer keyframes of its segment with its newest view that
/// is not fixed, a landmark with the newest such view that sees it or, if only newer keyframes do,
/// with the newest of all. A view takes along by the similarity of its own move and the median
/// ratio of the depths that it sees.
std::vector<TrackElement> WriteBack(const Bundle& bundle, Map& map);

}  // namespace corvo
