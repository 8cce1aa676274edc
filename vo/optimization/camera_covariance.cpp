// SPDX-License-Identifier: MIT
#include "vo/optimization/camera_covariance.h"

#include <limits>

#include <Eigen/LU>

#include "vo/camera/differentiable_camera.h"
#include "vo/optimization/reduced_information.h"

namespace corvo {
namespace {

/// Inverts an information matrix in units that make its diagonal 1. Returns infinities if the
/// matrix is singular.
Eigen::MatrixXd Invert(const Eigen::MatrixXd& information) {
  const double infinity = std::numeric_limits<double>::infinity();
  const Eigen::VectorXd units = information.diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::FullPivLU<Eigen::MatrixXd> scaled(units.asDiagonal() * information *
                                                 units.asDiagonal());
  if (!units.allFinite() || !scaled.isInvertible()) {
    return Eigen::MatrixXd::Constant(information.rows(), information.cols(), infinity);
  }
  return units.asDiagonal() * scaled.inverse() * units.asDiagonal();
}

}  // namespace

CameraInformation ObservedInformation(const CameraPrior& prior, const AdjustmentState& state) {
  const int num_free = prior.num_free();
  CameraInformation sum{Eigen::MatrixXd::Zero(num_free, num_free), Eigen::VectorXd::Zero(num_free)};
  if (num_free == 0) return sum;
  const DifferentiableCamera adjusted(prior, state.difference);
  for (std::size_t i = 0; i < state.bundles.size(); ++i) {
    const Bundle& bundle = state.bundles[i];
    const CameraInformation of_change =
        ReducedInformation(bundle, state.is_joint[i], adjusted, num_free)
            .MarginalizePoses(bundle.views);
    sum.matrix += of_change.matrix;
    sum.vector += of_change.vector;
  }
  sum.vector += sum.matrix * state.difference;
  return sum;
}

Eigen::MatrixXd CameraCovariance(const CameraPrior& prior, const Eigen::MatrixXd& information) {
  if (prior.num_free() == 0) return {};
  return Invert(information + PriorInformation(prior));
}

}  // namespace corvo
