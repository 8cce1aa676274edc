// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <vector>

#include <ceres/iteration_callback.h>
#include <ceres/loss_function.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <Eigen/Core>

#include "vo/camera/camera_prior.h"
#include "vo/optimization/adjusted_camera.h"
#include "vo/optimization/adjustment_state.h"
#include "vo/optimization/bundle_adjuster.h"

namespace corvo {

/// A nonlinear least-squares problem over the views, the joint points and the camera, to be solved
/// once. The solution is reproducible to the bit (one thread, Eigen's linear algebra, elimination
/// ordered by position).
class BundleProblem {
 public:
  BundleProblem(const CameraPrior& prior, const AdjustmentOptions& options, AdjustmentState& state);

  /// Minimizes the cost and sets the state to the solution. The state is undefined unless the
  /// returned status is usable.
  AdjustmentStatus Solve(ceres::IterationCallback& callback);

 private:
  void AddObservations();
  /// Sets the manifolds of the poses and fixes the gauge of a bundle.
  void FixGauge(Bundle& bundle);
  /// Returns the elimination order: first the points, then the poses of one bundle after the other,
  /// and the camera last.
  std::shared_ptr<ceres::ParameterBlockOrdering> EliminationOrder();
  ceres::Solver::Options SolverOptions() const;
  void WriteBackPoints();

  const CameraPrior& prior_;
  const AdjustmentOptions& options_;
  AdjustmentState& state_;
  std::vector<Eigen::Vector3d> points_;  // All points, eliminated in the order of addresses.
  AdjustedCamera camera_;
  std::unique_ptr<ceres::LossFunction> loss_;
  ceres::Problem problem_;
};

}  // namespace corvo
