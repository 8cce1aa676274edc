#include "vo/optimization/bundle_adjuster.h"

#include <map>
#include <set>

#include <ceres/ceres.h>

#include "vo/math/chi_square.h"
#include "vo/math/huber.h"
#include "vo/optimization/bundle_problem.h"
#include "vo/optimization/point_adjuster.h"
#include "vo/optimization/point_selection.h"
#include "vo/optimization/reprojection_cost.h"

namespace corvo {
namespace {

ceres::Solver::Summary Solve(const Camera& camera, const BundleAdjusterOptions& options,
                             const std::vector<char>& is_selected, Bundle& bundle) {
  ceres::Problem::Options problem_options;
  problem_options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::HuberLoss huber(options.huber_sigmas);
  ceres::Problem problem(problem_options);
  for (const Bundle::Observation& observation : bundle.observations) {
    if (!observation.is_inlier || !is_selected[observation.point]) continue;
    problem.AddResidualBlock(new ReprojectionCost(camera, observation.pixel, observation.sigma_px),
                             &huber, bundle.views[observation.view].local_from_camera.data(),
                             bundle.points[observation.point].in_local.data());
  }
  FixGauge(bundle, problem);
  ceres::Solver::Summary summary;
  ceres::Solve(SolverOptions(options.max_iterations), &problem, &summary);
  return summary;
}

/// With the landmarks that the free keyframes see, and the others that hold them.
AdjustmentWindow CompleteWindow(const Map& map, const std::set<KeyframeId>& free,
                                int min_shared_landmarks) {
  AdjustmentWindow window;
  window.free.assign(free.begin(), free.end());
  window.landmarks = map.FindObserved(window.free);
  std::map<KeyframeId, int> num_seen;
  for (const LandmarkId id : window.landmarks) {
    for (const TrackElement& o : map.FindLandmark(id)->track) {
      if (free.count(o.keyframe) == 0) ++num_seen[o.keyframe];
    }
  }
  for (const auto& [id, count] : num_seen) {
    if (count >= min_shared_landmarks) window.fixed.push_back(id);
  }
  return window;
}

}  // namespace

AdjustmentWindow SelectWindow(const Map& map, KeyframeId newest,
                              const BundleAdjusterOptions& options) {
  std::set<KeyframeId> free{newest};
  for (const Covisible& covisible : map.FindCovisible(newest, options.min_shared_landmarks)) {
    if (static_cast<int>(free.size()) == options.max_keyframes) break;
    free.insert(covisible.keyframe);
  }
  return CompleteWindow(map, free, options.min_shared_landmarks);
}

AdjustmentWindow SelectNewestKeyframes(const Map& map, KeyframeId newest, int max_keyframes,
                                       const BundleAdjusterOptions& options) {
  std::set<KeyframeId> free;
  const std::vector<KeyframeId> kept = map.ActiveKeyframes();
  for (auto id = kept.rbegin(); id != kept.rend(); ++id) {
    if (map.SegmentOf(*id) != map.SegmentOf(newest)) break;
    free.insert(*id);
    if (static_cast<int>(free.size()) == max_keyframes) break;
  }
  return CompleteWindow(map, free, options.min_shared_landmarks);
}

AdjustmentResult AdjustBundle(const Camera& camera, const BundleAdjusterOptions& options,
                              Bundle& bundle) {
  constexpr double kProjects = 1e12;
  const Bundle before = bundle;
  MarkOutliers(camera, kProjects, bundle);
  const std::vector<char> is_selected = SelectPoints(bundle, options.points_per_keyframe);
  const ceres::Solver::Summary summary = Solve(camera, options, is_selected, bundle);
  if (!summary.IsSolutionUsable()) {
    bundle = before;
    return {};
  }
  AdjustPoints(camera, is_selected, bundle);
  MarkOutliers(camera, kChiSquare2Dof95, bundle);
  return {true, summary.initial_cost, summary.final_cost};
}

}  // namespace corvo
