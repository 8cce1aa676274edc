#include "vo/bundle.h"

#include <algorithm>

#include "vo/pose_optimizer.h"

namespace corvo {
namespace {

std::vector<Bundle::View> CopyViews(const Map& map, const AdjustmentWindow& window,
                                    const SE3& local_from_world) {
  std::vector<Bundle::View> views;
  const auto copy = [&](KeyframeId id, bool is_held) {
    views.push_back({id, is_held, (local_from_world * map.WorldFromKeyframe(id)).data()});
  };
  for (const KeyframeId id : window.moving) copy(id, false);
  for (const KeyframeId id : window.held) copy(id, true);
  std::sort(views.begin(), views.end(),
            [](const auto& a, const auto& b) { return a.keyframe < b.keyframe; });
  return views;
}

/// Index of a keyframe's view; kNoId if the bundle has none.
int FindView(const std::vector<Bundle::View>& views, KeyframeId keyframe) {
  const auto found =
      std::lower_bound(views.begin(), views.end(), keyframe,
                       [](const auto& view, KeyframeId id) { return view.keyframe < id; });
  if (found == views.end() || found->keyframe != keyframe) return kNoId;
  return static_cast<int>(found - views.begin());
}

void CopyLandmark(const Map& map, LandmarkId id, const SE3& local_from_world,
                  const KeypointNoise& noise, Bundle& bundle) {
  const Landmark& landmark = *map.FindLandmark(id);
  const int point = static_cast<int>(bundle.points.size());
  bundle.points.push_back({id, local_from_world * landmark.in_world});
  for (const Observation& observation : landmark.observations) {
    const int view = FindView(bundle.views, observation.keyframe);
    if (view == kNoId) continue;
    const Frame& frame = map.keyframe(observation.keyframe).frame;
    const int k = observation.keypoint;
    bundle.sightings.push_back({view, point, k, frame.pixel(k), noise.Sigma(frame, k)});
  }
}

std::vector<SE3> InvertPoses(const Bundle& bundle) {
  std::vector<SE3> poses;
  for (const Bundle::View& view : bundle.views) poses.push_back(view.Pose().Inverse());
  return poses;
}

}  // namespace

Bundle CopyBundle(const Map& map, const AdjustmentWindow& window, const KeypointNoise& noise) {
  Bundle bundle;
  KeyframeId oldest = window.moving.front();
  if (!window.held.empty()) oldest = std::min(oldest, window.held.front());
  bundle.world_from_local = map.WorldFromKeyframe(oldest);
  const SE3 local_from_world = bundle.world_from_local.Inverse();
  bundle.views = CopyViews(map, window, local_from_world);
  bundle.points.reserve(window.landmarks.size());
  for (const LandmarkId id : window.landmarks) {
    CopyLandmark(map, id, local_from_world, noise, bundle);
  }
  return bundle;
}

void MarkOutliers(const Camera& camera, double max_squared_error, Bundle& bundle) {
  const std::vector<SE3> camera_from_local = InvertPoses(bundle);
  for (Bundle::Sighting& sighting : bundle.sightings) {
    const PointObservation observation{bundle.points[sighting.point].in_local, sighting.pixel,
                                       sighting.sigma_px};
    sighting.is_inlier =
        SquaredError(observation, camera_from_local[sighting.view], camera) <= max_squared_error;
  }
}

std::vector<Observation> WriteBack(const Bundle& bundle, Map& map) {
  for (const Bundle::View& view : bundle.views) {
    if (!view.is_held) map.SetPose(view.keyframe, bundle.world_from_local * view.Pose());
  }
  for (const Bundle::Point& point : bundle.points) {
    map.SetPosition(point.landmark, bundle.world_from_local * point.in_local);
  }
  std::vector<Observation> outliers;
  for (const Bundle::Sighting& sighting : bundle.sightings) {
    if (sighting.is_inlier) continue;
    const KeyframeId keyframe = bundle.views[sighting.view].keyframe;
    const LandmarkId landmark = bundle.points[sighting.point].landmark;
    outliers.push_back({keyframe, sighting.keypoint});
    if (map.FindLandmark(landmark) != nullptr) map.RemoveObservation(landmark, keyframe);
  }
  return outliers;
}

}  // namespace corvo
