#pragma once

#include <optional>

#include <ceres/cost_function.h>
#include <ceres/evaluation_callback.h>
#include <Eigen/Core>

#include "vo/camera/camera_prior.h"
#include "vo/camera/differentiable_camera.h"
#include "vo/optimization/bundle.h"

namespace corvo {

/// Of a observation that does not project, in units of sigma.
inline constexpr double kUnseenError = 1e3;

/// A camera among the unknowns of a least-squares problem: made anew from its difference, see
/// CameraPrior, before each evaluation. Both have to outlive it.
class AdjustedCamera : public ceres::EvaluationCallback {
 public:
  AdjustedCamera(const CameraPrior& prior, const Eigen::VectorXd& difference)
      : prior_(prior), difference_(difference) {}

  void PrepareForEvaluation(bool evaluate_jacobians, bool new_evaluation_point) override;

  /// Null where the difference is no camera's: a step too far, which the solver takes back.
  const DifferentiableCamera* camera() const { return camera_ ? &*camera_ : nullptr; }
  int num_free() const { return prior_.num_free(); }

 private:
  const CameraPrior& prior_;
  const Eigen::VectorXd& difference_;
  std::optional<DifferentiableCamera> camera_;
};

/// ReprojectionCost whose third parameter, where anything of the camera is free, is its difference.
/// A point that does not project has the error (kUnseenError, 0), and no derivative. `adjusted` has
/// to outlive it.
ceres::CostFunction* MakeReprojectionCost(const AdjustedCamera& adjusted,
                                          const Bundle::Observation& observation);

/// d / sigma, one residual a free parameter.
ceres::CostFunction* MakePriorCost(const CameraPrior& prior);

}  // namespace corvo
