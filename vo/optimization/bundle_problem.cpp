#include "vo/optimization/bundle_problem.h"

#include <algorithm>

#include <ceres/ceres.h>

#include "vo/lie/se3_manifold.h"

namespace corvo {
namespace {

/// The pose farthest from the oldest one, whose distance determines the scale best.
double* FarthestPose(Bundle& bundle, const ceres::Problem& problem) {
  double* farthest = nullptr;
  double max_distance = 0;
  for (Bundle::View& view : bundle.views) {
    const double distance = view.Pose().translation().norm();
    double* pose = view.local_from_camera.data();
    if (distance <= max_distance || !problem.HasParameterBlock(pose)) continue;
    farthest = pose;
    max_distance = distance;
  }
  return farthest;
}

}  // namespace

void FixGauge(Bundle& bundle, ceres::Problem& problem) {
  const auto num_fixed = std::count_if(bundle.views.begin(), bundle.views.end(),
                                       [](const Bundle::View& view) { return view.is_fixed; });
  for (Bundle::View& view : bundle.views) {
    double* pose = view.local_from_camera.data();
    if (!problem.HasParameterBlock(pose)) continue;
    problem.SetManifold(pose, new SE3Manifold);
    const bool is_oldest = &view == &bundle.views.front();
    if (view.is_fixed || (num_fixed < 2 && is_oldest)) problem.SetParameterBlockConstant(pose);
  }
  const bool scale_is_free = num_fixed == 0 || (num_fixed == 1 && bundle.views.front().is_fixed);
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

}  // namespace corvo
