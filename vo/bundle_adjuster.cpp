#include "vo/bundle_adjuster.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <ceres/ceres.h>

#include "vo/chi_square.h"
#include "vo/lie/se3_manifold.h"
#include "vo/pose_optimizer.h"
#include "vo/reprojection_cost.h"

namespace corvo {
namespace {

SE3 ToPose(const Bundle::View& view) { return SE3::FromData(view.local_from_camera.data()); }

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
  for (const Bundle::View& view : bundle.views) poses.push_back(ToPose(view).Inverse());
  return poses;
}

/// Marks as outliers the sightings over a squared error, in units of sigma².
void MarkOutliers(const Camera& camera, double max_squared_error, Bundle& bundle) {
  const std::vector<SE3> camera_from_local = InvertPoses(bundle);
  for (Bundle::Sighting& sighting : bundle.sightings) {
    const PointObservation observation{bundle.points[sighting.point].in_local, sighting.pixel,
                                       sighting.sigma_px};
    sighting.is_inlier =
        SquaredError(observation, camera_from_local[sighting.view], camera) <= max_squared_error;
  }
}

/// The pose farthest from the oldest one, whose distance determines the scale best.
double* FarthestPose(Bundle& bundle, const ceres::Problem& problem) {
  double* farthest = nullptr;
  double max_distance = 0;
  for (Bundle::View& view : bundle.views) {
    const double distance = ToPose(view).translation().norm();
    double* pose = view.local_from_camera.data();
    if (distance <= max_distance || !problem.HasParameterBlock(pose)) continue;
    farthest = pose;
    max_distance = distance;
  }
  return farthest;
}

/// Holds poses: the held views, or else the oldest one and the farthest one's distance from it.
void FixGauge(Bundle& bundle, ceres::Problem& problem) {
  const auto num_held = std::count_if(bundle.views.begin(), bundle.views.end(),
                                      [](const Bundle::View& view) { return view.is_held; });
  for (Bundle::View& view : bundle.views) {
    double* pose = view.local_from_camera.data();
    if (!problem.HasParameterBlock(pose)) continue;
    problem.SetManifold(pose, new SE3Manifold);
    const bool is_oldest = &view == &bundle.views.front();
    if (view.is_held || (num_held < 2 && is_oldest)) problem.SetParameterBlockConstant(pose);
  }
  const bool scale_is_free = num_held == 0 || (num_held == 1 && bundle.views.front().is_held);
  double* farthest = scale_is_free ? FarthestPose(bundle, problem) : nullptr;
  if (farthest == nullptr) return;
  problem.SetManifold(
      farthest,
      new ceres::ProductManifold<ceres::EigenQuaternionManifold, ceres::SphereManifold<3>>);
}

ceres::Solver::Options SolverOptions(int max_iterations) {
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.dense_linear_algebra_library_type = ceres::EIGEN;
  options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
  options.num_threads = 1;
  options.max_num_iterations = max_iterations;
  options.max_solver_time_in_seconds = 1e9;
  options.function_tolerance = 1e-5;
  options.logging_type = ceres::SILENT;
  return options;
}

ceres::Solver::Summary Solve(const Camera& camera, int max_iterations, Bundle& bundle) {
  ceres::Problem::Options problem_options;
  problem_options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::HuberLoss huber(std::sqrt(kChiSquare2Dof95));
  ceres::Problem problem(problem_options);
  for (const Bundle::Sighting& sighting : bundle.sightings) {
    if (!sighting.is_inlier) continue;
    problem.AddResidualBlock(new ReprojectionCost(camera, sighting.pixel, sighting.sigma_px),
                             &huber, bundle.views[sighting.view].local_from_camera.data(),
                             bundle.points[sighting.point].in_local.data());
  }
  FixGauge(bundle, problem);
  ceres::Solver::Summary summary;
  ceres::Solve(SolverOptions(max_iterations), &problem, &summary);
  return summary;
}

}  // namespace

AdjustmentWindow SelectWindow(const Map& map, KeyframeId newest,
                              const BundleAdjusterOptions& options) {
  std::set<KeyframeId> moving{newest};
  for (const Covisible& covisible : map.FindCovisible(newest, options.min_shared_landmarks)) {
    if (static_cast<int>(moving.size()) == options.max_keyframes) break;
    moving.insert(covisible.keyframe);
  }
  AdjustmentWindow window;
  window.moving.assign(moving.begin(), moving.end());
  window.landmarks = map.FindSeen(window.moving);
  std::map<KeyframeId, int> num_seen;
  for (const LandmarkId id : window.landmarks) {
    for (const Observation& o : map.FindLandmark(id)->observations) {
      if (moving.count(o.keyframe) == 0) ++num_seen[o.keyframe];
    }
  }
  for (const auto& [id, count] : num_seen) {
    if (count >= options.min_shared_landmarks) window.held.push_back(id);
  }
  return window;
}

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

AdjustmentResult AdjustBundle(const Camera& camera, const BundleAdjusterOptions& options,
                              Bundle& bundle) {
  constexpr double kProjects = 1e12;
  const Bundle before = bundle;
  MarkOutliers(camera, kProjects, bundle);
  const ceres::Solver::Summary summary = Solve(camera, options.max_iterations, bundle);
  if (!summary.IsSolutionUsable()) {
    bundle = before;
    return {};
  }
  MarkOutliers(camera, kChiSquare2Dof95, bundle);
  return {true, summary.initial_cost, summary.final_cost};
}

std::vector<Observation> WriteBack(const Bundle& bundle, Map& map) {
  for (const Bundle::View& view : bundle.views) {
    if (!view.is_held) map.SetPose(view.keyframe, bundle.world_from_local * ToPose(view));
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
