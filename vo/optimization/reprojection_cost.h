// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/cost_function.h>
#include <Eigen/Core>

#include "vo/map/observation.h"
#include "vo/optimization/adjusted_camera.h"

namespace corvo {

/// Reprojection error of one observation in units of its standard deviation, with analytic
/// derivatives:
///
///     r = (project(world_from_camera⁻¹ * x_in_world) - pixel) / sigma
///
/// Parameters: world_from_camera as [qx qy qz qw tx ty tz] with a unit quaternion, on an
/// SE3Manifold; x_in_world (3); and, if anything of the camera is free, its difference from the
/// given camera. The derivative by the seven numbers of the pose is the one along the manifold:
/// times the manifold's PlusJacobian it is d r / d [υ ω]. A point that does not project has the
/// error (kUnprojectableError, 0), and no derivative.
class ReprojectionCost : public ceres::CostFunction {
 public:
  /// The camera has to outlive the cost.
  ReprojectionCost(const AdjustedCamera& camera, const Observation& observation);

  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  void SetCameraJacobian(const Eigen::Vector3d& in_camera, const Eigen::Vector2d& projected,
                         double* jacobian) const;
  void SetUnprojectable(double* residuals, double** jacobians) const;

  const AdjustedCamera& camera_;
  Eigen::Vector2d pixel_;
  double sigma_px_;
};

/// d / sigma, one residual for each free parameter of the camera.
ceres::CostFunction* MakePriorCost(const CameraPrior& prior);

}  // namespace corvo
