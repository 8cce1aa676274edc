#pragma once

#include <ceres/sized_cost_function.h>
#include <Eigen/Core>

#include "vo/camera/camera.h"

namespace corvo {

/// Reprojection error of one observation in units of its standard deviation, with analytic
/// derivatives:
///
///     r = (project(world_from_camera⁻¹ * x_in_world) - pixel) / sigma
///
/// Parameters: world_from_camera as [qx qy qz qw tx ty tz] with a unit quaternion, on an
/// SE3Manifold; x_in_world (3). The derivative by the seven pose numbers is the one along the
/// manifold: times the manifold's PlusJacobian it is d r / d [υ ω]. Evaluation fails where the
/// point does not project.
class ReprojectionCost : public ceres::SizedCostFunction<2, 7, 3> {
 public:
  /// The camera must live as long as the cost.
  ReprojectionCost(const Camera& camera, const Eigen::Vector2d& pixel, double sigma_px);
  ReprojectionCost(Camera&&, const Eigen::Vector2d&, double) = delete;

  bool Evaluate(const double* const* parameters, double* residuals,
                double** jacobians) const override;

 private:
  const Camera& camera_;
  Eigen::Vector2d pixel_;
  double sigma_px_;
};

}  // namespace corvo
