// SPDX-License-Identifier: MIT
#include <vector>

#include "tests/fuzz/cameras.h"
#include "tests/fuzz/targets.h"
#include "vo/optimization/bundle_adjuster.h"
#include "vo/optimization/pose_optimizer.h"

namespace corvo::fuzz {
namespace {

constexpr int kWidth = 320, kHeight = 240;

SE3 TakePose(int kind, int index, Input& input) {
  switch (kind) {
    case 0:
      return {};  // No baseline.
    case 1:
      return {SO3(), {0.1 * index, 0, 0}};  // Along a line.
    case 2:
      return {SO3::Exp({0, 0.1 * index, 0}), {0, 0, 0}};  // Rotation only.
    case 3:
      return {SO3(), {1e6 * index, 0, 0}};
    default:
      break;
  }
  const SO3 rotation = SO3::Exp(input.Vector(1));
  return {rotation, input.Vector(2)};
}

Eigen::Vector3d TakePoint(int kind, Input& input) {
  const double x = input.Real(-3, 3), y = input.Real(-3, 3);
  switch (kind) {
    case 0:
      return {0, 0, 4};  // All at one place.
    case 1:
      return {x, y, 4};  // On a plane.
    case 2:
      return {x, 0, 4};  // On a line.
    case 3:
      return {0, 0, 0};  // At the center of a camera.
    case 4:
      return {1e8 * x, 1e8 * y, 1e9};
    case 5:
      return {x, y, -4};  // Behind the cameras.
    default:
      return {x, y, input.Real(-1, 8)};
  }
}

Eigen::Vector2d TakePixel(const Camera& camera, const Eigen::Vector3d& in_camera, Input& input) {
  const Eigen::Vector2d any(input.Real(-0.5, kWidth - 0.5), input.Real(-0.5, kHeight - 0.5));
  if (input.Int(0, 7) == 0) return any;
  const auto projected = camera.Project(in_camera);
  return projected && camera.Contains(*projected) ? *projected : any;
}

Bundle TakeBundle(const Camera& camera, Input& input) {
  Bundle bundle;
  const int num_views = input.Int(0, 6), num_points = input.Int(0, 30);
  const int pose_kind = input.Int(0, 4), point_kind = input.Int(0, 6);
  const double sigma_px = input.Bool() ? 1 : input.Real(0.01, 100);
  for (int i = 0; i < num_views; ++i) {
    bundle.views.push_back({i, input.Int(0, 3) == 0, TakePose(pose_kind, i, input).data()});
  }
  const std::vector<SE3> cameras_from_local = CamerasFromLocal(bundle);
  for (int p = 0; p < num_points; ++p) {
    bundle.points.push_back({p, TakePoint(point_kind, input)});
    for (int v = 0; v < num_views; ++v) {
      if (input.Int(0, 3) == 0) continue;
      Bundle::Observation observation;
      observation.landmark = p;
      observation.pixel =
          TakePixel(camera, cameras_from_local[v] * bundle.points.back().in_local, input);
      observation.sigma_px = sigma_px;
      observation.view = v;
      observation.point = p;
      bundle.observations.push_back(observation);
    }
  }
  return bundle;
}

AdjustmentOptions TakeAdjustmentOptions(Input& input) {
  AdjustmentOptions options;
  options.num_rounds = input.Int(1, 3);
  options.max_iterations = input.Int(1, 15);
  options.points_per_view = input.Bool() ? 0 : input.Int(1, 10);
  options.max_dense_views = input.Bool() ? 300 : 1;
  options.information_factor = input.Bool() ? 1 : input.Real(0.1, 10);
  return options;
}

CameraPrior TakePrior(const Camera& camera, Input& input) {
  CameraPrior prior{camera.parameters(), {}};
  for (const std::string& name : FreeParameterNames(camera.parameters().model)) {
    if (name == "fx" || name == "fy" || input.Bool()) continue;
    prior.free.push_back({name, input.Int(0, 7) == 0 ? INFINITY : input.Real(1e-6, 1)});
  }
  return prior;
}

void RequireBundle(const Bundle& bundle) {
  for (const Bundle::View& view : bundle.views) {
    Require(view.local_from_camera.allFinite(), "poses are finite");
  }
  for (const Bundle::Point& point : bundle.points) {
    Require(point.in_local.allFinite(), "points are finite");
  }
}

void RequireSummary(const AdjustmentSummary& summary) {
  Require(summary.camera.IsValid(), "the adjusted camera is valid");
  Require(summary.num_inliers <= summary.num_observations, "inliers are observations");
  if (!summary.is_usable()) return;
  Require(std::isfinite(summary.final_cost) && std::isfinite(summary.inlier_rms_px),
          "a usable adjustment has a finite cost");
  Require(summary.estimate.difference.allFinite(), "the estimated camera is finite");
}

void LocateViews(const Bundle& bundle, const Camera& camera) {
  for (std::size_t v = 0; v < bundle.views.size(); ++v) {
    PoseObservations observations;
    for (const Bundle::Observation& observation : bundle.observations) {
      if (observation.view != static_cast<int>(v)) continue;
      observations.Add({bundle.points[observation.point].in_local}, observation);
    }
    const PoseEstimate estimate = OptimizePose(SE3(), observations, camera);
    Require(IsFinite(estimate.world_from_camera), "an optimized pose is finite");
  }
}

}  // namespace

void FuzzBundle(Bytes bytes) {
  Input input(bytes);
  const std::optional<Camera> camera = Camera::Make(TakeCamera(kWidth, kHeight, true, input));
  if (!camera) return;
  const AdjustmentOptions options = TakeAdjustmentOptions(input);
  const CameraPrior prior = TakePrior(*camera, input);
  std::vector<Bundle> bundles;
  const int num_bundles = input.Int(1, 2);
  for (int i = 0; i < num_bundles; ++i) bundles.push_back(TakeBundle(*camera, input));
  for (const Bundle& bundle : bundles) LocateViews(bundle, *camera);
  AllowError([&] {
    RequireSummary(BundleAdjuster(options).Adjust(prior, camera->parameters(), bundles));
    for (const Bundle& bundle : bundles) RequireBundle(bundle);
  });
}

}  // namespace corvo::fuzz
