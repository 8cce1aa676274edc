// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include <ceres/evaluation_callback.h>
#include <Eigen/Core>

#include "vo/camera/camera_prior.h"
#include "vo/camera/differentiable_camera.h"

namespace corvo {

/// The camera of a least-squares problem whose difference from the given camera, see CameraPrior,
/// may be a free parameter. It is constructed anew for each evaluation point.
class AdjustedCamera : public ceres::EvaluationCallback {
 public:
  /// `prior` and `difference` must outlive this object.
  AdjustedCamera(const CameraPrior& prior, const Eigen::VectorXd& difference)
      : prior_(prior), difference_(difference) {}

  void PrepareForEvaluation(bool /*evaluate_jacobians*/, bool new_evaluation_point) override {
    if (new_evaluation_point || !camera_) {
      camera_ = DifferentiableCamera::Make(prior_, difference_);
    }
  }

  /// Returns null if the difference does not yield a valid camera: the step was too long, and the
  /// solver rejects it.
  const DifferentiableCamera* camera() const { return camera_ ? &*camera_ : nullptr; }
  int num_free() const { return prior_.num_free(); }

 private:
  const CameraPrior& prior_;
  const Eigen::VectorXd& difference_;
  std::optional<DifferentiableCamera> camera_;
};

}  // namespace corvo
