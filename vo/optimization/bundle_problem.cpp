// SPDX-License-Identifier: MIT
#include "vo/optimization/bundle_problem.h"

#include <algorithm>

#include <ceres/ceres.h>

#include "vo/lie/se3_manifold.h"
#include "vo/optimization/reprojection_cost.h"

namespace corvo {
namespace {

ceres::Problem::Options ProblemOptions(ceres::EvaluationCallback& callback) {
  ceres::Problem::Options options;
  options.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  options.evaluation_callback = &callback;
  return options;
}

/// Returns the pose farthest from the oldest one, whose distance determines the scale best, or null
/// if there is none.
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

AdjustmentStatus ToStatus(const ceres::Solver::Summary& summary) {
  switch (summary.termination_type) {
    case ceres::CONVERGENCE:
    case ceres::USER_SUCCESS:
      return AdjustmentStatus::kConverged;
    case ceres::NO_CONVERGENCE:
      return AdjustmentStatus::kIterationLimit;
    case ceres::USER_FAILURE:
      return AdjustmentStatus::kCanceled;
    case ceres::FAILURE:
      break;
  }
  return AdjustmentStatus::kSolverFailed;
}

}  // namespace

BundleProblem::BundleProblem(const CameraPrior& prior, const AdjustmentOptions& options,
                             AdjustmentState& state)
    : prior_(prior),
      options_(options),
      state_(state),
      camera_(prior, state.difference),
      loss_(std::make_unique<ceres::HuberLoss>(options.huber_sigmas)),
      problem_(ProblemOptions(camera_)) {
  for (const Bundle& bundle : state_.bundles) {
    for (const Bundle::Point& point : bundle.points) points_.push_back(point.in_local);
  }
  AddObservations();
  if (prior_.num_free() > 0) {
    problem_.AddResidualBlock(MakePriorCost(prior_), nullptr, state_.difference.data());
  }
  for (Bundle& bundle : state_.bundles) FixGauge(bundle);
}

AdjustmentStatus BundleProblem::Solve(ceres::IterationCallback& callback) {
  ceres::Solver::Options options = SolverOptions();
  options.linear_solver_ordering = EliminationOrder();
  options.callbacks.push_back(&callback);
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem_, &summary);
  WriteBackPoints();
  return ToStatus(summary);
}

void BundleProblem::AddObservations() {
  Eigen::Vector3d* points = points_.data();
  for (std::size_t i = 0; i < state_.bundles.size(); ++i) {
    Bundle& bundle = state_.bundles[i];
    for (const Bundle::Observation& observation : bundle.observations) {
      if (!observation.is_inlier || !state_.is_joint[i][observation.point]) continue;
      std::vector<double*> blocks{bundle.views[observation.view].local_from_camera.data(),
                                  points[observation.point].data()};
      if (prior_.num_free() > 0) blocks.push_back(state_.difference.data());
      problem_.AddResidualBlock(new ReprojectionCost(camera_, observation), loss_.get(), blocks);
    }
    points += bundle.points.size();
  }
}

void BundleProblem::FixGauge(Bundle& bundle) {
  const auto num_fixed = std::count_if(bundle.views.begin(), bundle.views.end(),
                                       [](const Bundle::View& view) { return view.is_fixed; });
  for (Bundle::View& view : bundle.views) {
    double* pose = view.local_from_camera.data();
    if (!problem_.HasParameterBlock(pose)) continue;
    problem_.SetManifold(pose, new SE3Manifold);
    const bool is_oldest = &view == &bundle.views.front();
    if (view.is_fixed || (num_fixed < 2 && is_oldest)) problem_.SetParameterBlockConstant(pose);
  }
  const bool scale_is_free = num_fixed == 0 || (num_fixed == 1 && bundle.views.front().is_fixed);
  double* farthest = scale_is_free ? FarthestPose(bundle, problem_) : nullptr;
  if (farthest == nullptr) return;
  problem_.SetManifold(
      farthest,
      new ceres::ProductManifold<ceres::EigenQuaternionManifold, ceres::SphereManifold<3>>);
}

std::shared_ptr<ceres::ParameterBlockOrdering> BundleProblem::EliminationOrder() {
  auto order = std::make_shared<ceres::ParameterBlockOrdering>();
  const auto add = [&](double* block, int group) {
    if (problem_.HasParameterBlock(block)) order->AddElementToGroup(block, group);
  };
  for (Eigen::Vector3d& point : points_) add(point.data(), 0);
  int group = 0;
  for (Bundle& bundle : state_.bundles) {
    ++group;
    for (Bundle::View& view : bundle.views) add(view.local_from_camera.data(), group);
  }
  if (prior_.num_free() > 0) add(state_.difference.data(), group + 1);
  return order;
}

ceres::Solver::Options BundleProblem::SolverOptions() const {
  int num_views = 0;
  for (const Bundle& bundle : state_.bundles) num_views += static_cast<int>(bundle.views.size());
  ceres::Solver::Options options;
  options.linear_solver_type =
      num_views > options_.max_dense_views ? ceres::SPARSE_SCHUR : ceres::DENSE_SCHUR;
  options.dense_linear_algebra_library_type = ceres::EIGEN;
  options.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
  options.num_threads = 1;
  options.max_num_iterations = options_.max_iterations;
  options.max_solver_time_in_seconds = 1e9;
  options.function_tolerance = 1e-5;
  options.logging_type = ceres::SILENT;
  return options;
}

void BundleProblem::WriteBackPoints() {
  auto solution = points_.begin();
  for (Bundle& bundle : state_.bundles) {
    for (Bundle::Point& point : bundle.points) point.in_local = *solution++;
  }
}

}  // namespace corvo
