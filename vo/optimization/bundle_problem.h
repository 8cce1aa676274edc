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

/// One nonlinear least-squares problem over the views, the joint points and the camera: solved
/// once, the same bits every time (one thread, Eigen's linear algebra, an elimination order by
/// position).
class BundleProblem {
 public:
  BundleProblem(const CameraPrior& prior, const AdjustmentOptions& options, AdjustmentState& state);

  /// Lowers the cost, and sets the state to the solution. Unless the status is usable, the state is
  /// undefined.
  AdjustmentStatus Solve(ceres::IterationCallback& callback);

 private:
  void AddObservations();
  /// Gives the poses their manifold and holds what fixes each bundle's gauge.
  void FixGauge(Bundle& bundle);
  /// Points first, then the poses of one bundle after the other, the camera last.
  std::shared_ptr<ceres::ParameterBlockOrdering> EliminationOrder();
  ceres::Solver::Options SolverOptions() const;
  void WriteBackPoints();

  const CameraPrior& prior_;
  const AdjustmentOptions& options_;
  AdjustmentState& state_;
  std::vector<Eigen::Vector3d> points_;  // Of all bundles: eliminated in the order of addresses.
  AdjustedCamera camera_;
  std::unique_ptr<ceres::LossFunction> loss_;
  ceres::Problem problem_;
};

}  // namespace corvo
