// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/cost_function.h>
#include <Eigen/Core>

#include "vo/map/observation.h"
#include "vo/optimization/adjusted_camera.h"

namespace corvo {

/// The reprojection error of one observation in units of its standard deviation, with analytic
/// derivatives:
///
///     r = (project(world_from_camera⁻¹ * x_in_world) - pixel) / sigma
///
/// Parameters: world_from_camera as [qx qy qz qw tx ty tz] with a unit quaternion, on an
/// SE3Manifold; x_in_world (3); and, if any parameter of the camera is free, its difference from
/// the given camera. The derivative with respect to the seven numbers of the pose is the one along
/// the manifold: multiplied by the manifold's PlusJacobian it is d r / d [υ ω]. A point that does
/// not project has the error (kUnprojectableError, 0) and zero derivatives.
class ReprojectionCost : public ceres::CostFunction {
 public:
  /// `camera` must outlive the cost.
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

/// Returns the cost d / sigma of the camera's difference d, with one residual for each free
/// parameter.
ceres::CostFunction* MakePriorCost(const CameraPrior& prior);

}  // namespace corvo
