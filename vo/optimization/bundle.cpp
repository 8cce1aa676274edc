// SPDX-License-Identifier: MIT
#include "vo/optimization/bundle.h"

#include <algorithm>
#include <numeric>

#include "vo/lie/sim3.h"
#include "vo/math/median.h"
#include "vo/optimization/reprojection_error.h"

namespace corvo {
namespace {

std::vector<Bundle::View> CopyViews(const Map& map, const AdjustmentWindow& window,
                                    const SE3& local_from_world) {
  std::vector<Bundle::View> views;
  const auto copy = [&](KeyframeId id, bool is_fixed) {
    views.push_back({id, is_fixed, (local_from_world * map.WorldFromKeyframe(id)).data()});
  };
  for (const KeyframeId id : window.free) copy(id, false);
  for (const KeyframeId id : window.fixed) copy(id, true);
  std::sort(views.begin(), views.end(),
            [](const auto& a, const auto& b) { return a.keyframe < b.keyframe; });
  return views;
}

/// Returns the index of a keyframe's view, or kNoId if the bundle has none.
int FindView(const std::vector<Bundle::View>& views, KeyframeId keyframe) {
  const auto found =
      std::lower_bound(views.begin(), views.end(), keyframe,
                       [](const auto& view, KeyframeId id) { return view.keyframe < id; });
  if (found == views.end() || found->keyframe != keyframe) return kNoId;
  return static_cast<int>(found - views.begin());
}

void CopyLandmark(const Map& map, LandmarkId id, const SE3& local_from_world, Bundle& bundle) {
  const Landmark& landmark = *map.FindLandmark(id);
  const int point = static_cast<int>(bundle.points.size());
  bundle.points.push_back({id, local_from_world * landmark.in_world});
  for (const auto& [keyframe, k] : landmark.track) {
    const int view = FindView(bundle.views, keyframe);
    if (view == kNoId) continue;
    const Frame& frame = map.keyframe(keyframe).frame;
    bundle.observations.push_back({Observe(frame, k, map.model()), view, point});
  }
}

/// Returns world_after_from_world_before for the points that each view observes.
std::vector<Sim3> FindMoves(const Bundle& bundle, const Map& map) {
  std::vector<SE3> before;
  for (const Bundle::View& view : bundle.views) {
    before.push_back(map.WorldFromKeyframe(view.keyframe).Inverse());
  }
  const std::vector<SE3> after = CamerasFromLocal(bundle);
  std::vector<std::vector<double>> ratios(bundle.views.size());
  for (const Bundle::Observation& observation : bundle.observations) {
    const Bundle::Point& point = bundle.points[observation.point];
    const Landmark* landmark = map.FindLandmark(point.landmark);
    if (landmark == nullptr || !observation.is_inlier) continue;
    const double old_depth = (before[observation.view] * landmark->in_world).z();
    const double new_depth = (after[observation.view] * point.in_local).z();
    if (old_depth > 0 && new_depth > 0) ratios[observation.view].push_back(new_depth / old_depth);
  }
  std::vector<Sim3> moves;
  for (std::size_t view = 0; view < bundle.views.size(); ++view) {
    const double scale = ratios[view].empty() ? 1 : Median(ratios[view]);
    moves.push_back(Sim3(bundle.world_from_local * after[view].Inverse()) *
                    Sim3(scale, SO3(), Eigen::Vector3d::Zero()) * Sim3(before[view]));
  }
  return moves;
}

/// Returns the newest free view that observes a landmark, or kNoId if there is none.
int NewestMovingView(const Bundle& bundle, const Landmark& landmark) {
  for (auto o = landmark.track.rbegin(); o != landmark.track.rend(); ++o) {
    const int view = FindView(bundle.views, o->keyframe);
    if (view != kNoId && !bundle.views[view].is_fixed) return view;
  }
  return kNoId;
}

/// Moves the keyframes and landmarks that the bundle does not contain.
void PropagateCorrection(const Bundle& bundle, Map& map) {
  int newest = kNoId;
  std::vector<KeyframeId> free;
  for (int view = 0; view < static_cast<int>(bundle.views.size()); ++view) {
    if (bundle.views[view].is_fixed || !map.IsActive(bundle.views[view].keyframe)) continue;
    newest = view;
    free.push_back(bundle.views[view].keyframe);
  }
  if (newest == kNoId) return;
  const std::vector<Sim3> moves = FindMoves(bundle, map);
  const KeyframeId last = bundle.views[newest].keyframe;
  for (const KeyframeId id : map.ActiveKeyframes()) {
    if (id <= last || map.SegmentOf(id) != map.SegmentOf(last)) continue;
    free.push_back(id);
    map.SetPose(id, TransformPose(moves[newest], map.WorldFromKeyframe(id)));
  }
  for (const LandmarkId id : map.FindObserved(free)) {
    if (FindPoint(bundle, id) != kNoId) continue;
    const Landmark& landmark = *map.FindLandmark(id);
    int view = NewestMovingView(bundle, landmark);
    if (view == kNoId && landmark.track.front().keyframe > last) view = newest;
    if (view != kNoId) map.SetPosition(id, moves[view] * landmark.in_world);
  }
}

/// Returns whether the map still has an observation of a landmark.
bool HasTrackElement(const Map& map, LandmarkId landmark, const TrackElement& observation) {
  return map.FindLandmark(landmark) != nullptr && map.IsActive(observation.keyframe) &&
         map.keyframe(observation.keyframe).frame.landmarks[observation.keypoint] == landmark;
}

}  // namespace

std::vector<SE3> CamerasFromLocal(const Bundle& bundle) {
  std::vector<SE3> poses;
  for (const Bundle::View& view : bundle.views) poses.push_back(view.Pose().Inverse());
  return poses;
}

int FindPoint(const Bundle& bundle, LandmarkId landmark) {
  const auto found =
      std::ranges::lower_bound(bundle.points, landmark, {}, &Bundle::Point::landmark);
  if (found == bundle.points.end() || found->landmark != landmark) return kNoId;
  return static_cast<int>(found - bundle.points.begin());
}

std::vector<int> ObservationOffsets(const Bundle& bundle) {
  std::vector<int> offsets(bundle.points.size() + 1, 0);
  for (const Bundle::Observation& observation : bundle.observations)
    ++offsets[observation.point + 1];
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  return offsets;
}

Bundle CopyBundle(const Map& map, const AdjustmentWindow& window) {
  Bundle bundle;
  KeyframeId oldest = window.free.front();
  if (!window.fixed.empty()) oldest = std::min(oldest, window.fixed.front());
  bundle.world_from_local = map.WorldFromKeyframe(oldest);
  const SE3 local_from_world = bundle.world_from_local.Inverse();
  bundle.views = CopyViews(map, window, local_from_world);
  bundle.points.reserve(window.landmarks.size());
  for (const LandmarkId id : window.landmarks) {
    CopyLandmark(map, id, local_from_world, bundle);
  }
  return bundle;
}

std::vector<std::optional<Eigen::Vector2d>> PredictPixels(const Camera& camera,
                                                          const Bundle& bundle) {
  const std::vector<SE3> camera_from_local = CamerasFromLocal(bundle);
  std::vector<std::optional<Eigen::Vector2d>> pixels;
  pixels.reserve(bundle.observations.size());
  for (const Bundle::Observation& observation : bundle.observations) {
    pixels.push_back(camera.Project(camera_from_local[observation.view] *
                                    bundle.points[observation.point].in_local));
  }
  return pixels;
}

void VisitErrors(const Camera& camera, Bundle& bundle,
                 const std::function<void(Bundle::Observation&, double)>& visit) {
  const std::vector<SE3> camera_from_local = CamerasFromLocal(bundle);
  for (Bundle::Observation& observation : bundle.observations) {
    const Eigen::Vector3d in_camera =
        camera_from_local[observation.view] * bundle.points[observation.point].in_local;
    visit(observation, SquaredError(in_camera, observation, camera));
  }
}

void WriteBack(const Bundle& bundle, Map& map) {
  PropagateCorrection(bundle, map);
  for (const Bundle::View& view : bundle.views) {
    if (view.is_fixed || !map.IsActive(view.keyframe)) continue;
    map.SetPose(view.keyframe, bundle.world_from_local * view.Pose());
  }
  for (const Bundle::Point& point : bundle.points) {
    if (map.FindLandmark(point.landmark) == nullptr) continue;
    map.SetPosition(point.landmark, bundle.world_from_local * point.in_local);
  }
  for (const Bundle::Observation& observation : bundle.observations) {
    if (observation.is_inlier) continue;
    const TrackElement outlier{bundle.views[observation.view].keyframe, observation.keypoint};
    if (HasTrackElement(map, observation.landmark, outlier)) {
      map.RemoveTrackElement(observation.landmark, outlier.keyframe);
    }
  }
}

}  // namespace corvo
