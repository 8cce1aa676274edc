// SPDX-License-Identifier: MIT
#include "vo/optimization/reprojection_cost.h"

#include <algorithm>
#include <optional>

#include <ceres/normal_prior.h>
#include <Eigen/Geometry>

#include "vo/optimization/reprojection_error.h"

namespace corvo {
namespace {

using PoseJacobian = Eigen::Matrix<double, 2, 7, Eigen::RowMajor>;
using PointJacobian = Eigen::Matrix<double, 2, 3, Eigen::RowMajor>;
using CameraJacobian = Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor>;

/// Returns the derivative with respect to the pose. For X = T⁻¹ X_w and T ← T Exp([υ ω]):
/// dX = X × ω - υ, and along the manifold υ = Rᵀ dt and ω = 2 vec(q⁻¹ ⊗ dq).
PoseJacobian ComputePoseJacobian(const Camera::Jacobian& by_camera_point,
                                 const PointJacobian& by_world_point,
                                 const Eigen::Vector3d& in_camera, const Eigen::Quaterniond& q) {
  PoseJacobian by_pose;
  by_pose.rightCols<3>() = -by_world_point;
  for (int row = 0; row < 2; ++row) {
    const Eigen::Vector3d by_omega = 2 * Eigen::Vector3d(by_camera_point.row(row)).cross(in_camera);
    by_pose.row(row).head<3>() = q.w() * by_omega + q.vec().cross(by_omega);
    by_pose(row, 3) = -q.vec().dot(by_omega);
  }
  return by_pose;
}

}  // namespace

ReprojectionCost::ReprojectionCost(const AdjustedCamera& camera, const Observation& observation)
    : camera_(camera), pixel_(observation.pixel), sigma_px_(observation.sigma_px) {
  set_num_residuals(2);
  *mutable_parameter_block_sizes() = {7, 3};
  if (camera.num_free() > 0) mutable_parameter_block_sizes()->push_back(camera.num_free());
}

bool ReprojectionCost::Evaluate(const double* const* parameters, double* residuals,
                                double** jacobians) const {
  if (camera_.camera() == nullptr) return false;
  const Eigen::Map<const Eigen::Quaterniond> quaternion(parameters[0]);
  const Eigen::Map<const Eigen::Vector3d> translation(parameters[0] + 4);
  const Eigen::Map<const Eigen::Vector3d> in_world(parameters[1]);
  const Eigen::Matrix3d camera_from_world = quaternion.toRotationMatrix().transpose();
  const Eigen::Vector3d in_camera = camera_from_world * (in_world - translation);
  Camera::Jacobian by_camera_point;
  const std::optional<Eigen::Vector2d> projected = camera_.camera()->camera().Project(
      in_camera, jacobians != nullptr ? &by_camera_point : nullptr);
  if (!projected) {
    SetUnprojectable(residuals, jacobians);
    return true;
  }
  Eigen::Map<Eigen::Vector2d>{residuals} = (*projected - pixel_) / sigma_px_;
  if (jacobians == nullptr) return true;
  by_camera_point /= sigma_px_;
  const PointJacobian by_world_point = by_camera_point * camera_from_world;
  if (jacobians[0] != nullptr) {
    Eigen::Map<PoseJacobian>{jacobians[0]} =
        ComputePoseJacobian(by_camera_point, by_world_point, in_camera, quaternion);
  }
  if (jacobians[1] != nullptr) Eigen::Map<PointJacobian>{jacobians[1]} = by_world_point;
  if (camera_.num_free() > 0) SetCameraJacobian(in_camera, *projected, jacobians[2]);
  return true;
}

void ReprojectionCost::SetCameraJacobian(const Eigen::Vector3d& in_camera,
                                         const Eigen::Vector2d& projected, double* jacobian) const {
  if (jacobian == nullptr) return;
  Eigen::Map<CameraJacobian>{jacobian, 2, camera_.num_free()} =
      camera_.camera()->PixelByDifference(in_camera, projected) / sigma_px_;
}

void ReprojectionCost::SetUnprojectable(double* residuals, double** jacobians) const {
  residuals[0] = kUnprojectableError;
  residuals[1] = 0;
  if (jacobians == nullptr) return;
  for (const int size : parameter_block_sizes()) {
    double* jacobian = *jacobians++;
    if (jacobian != nullptr) std::fill_n(jacobian, 2 * size, 0.0);
  }
}

ceres::CostFunction* MakePriorCost(const CameraPrior& prior) {
  Eigen::VectorXd weights(prior.num_free());
  for (int i = 0; i < prior.num_free(); ++i) weights[i] = 1 / prior.free[i].sigma;
  return new ceres::NormalPrior(weights.asDiagonal().toDenseMatrix(),
                                Eigen::VectorXd::Zero(prior.num_free()));
}

}  // namespace corvo
