// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include <ceres/evaluation_callback.h>
#include <Eigen/Core>

#include "vo/camera/camera_prior.h"
#include "vo/camera/differentiable_camera.h"

namespace corvo {

/// The camera of a least-squares problem in which its difference from the given one, see
/// CameraPrior, may be unknown: constructed anew before each evaluation.
class AdjustedCamera : public ceres::EvaluationCallback {
 public:
  /// Both have to outlive it.
  AdjustedCamera(const CameraPrior& prior, const Eigen::VectorXd& difference)
      : prior_(prior), difference_(difference) {}

  void PrepareForEvaluation(bool /*evaluate_jacobians*/, bool new_evaluation_point) override {
    if (new_evaluation_point || !camera_) {
      camera_ = DifferentiableCamera::Make(prior_, difference_);
    }
  }

  /// Null where the difference is not that of a camera: the step was too long, and the solver takes
  /// it back.
  const DifferentiableCamera* camera() const { return camera_ ? &*camera_ : nullptr; }
  int num_free() const { return prior_.num_free(); }

 private:
  const CameraPrior& prior_;
  const Eigen::VectorXd& difference_;
  std::optional<DifferentiableCamera> camera_;
};

}  // namespace corvo
