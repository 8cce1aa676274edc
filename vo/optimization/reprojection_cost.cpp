#include "vo/optimization/reprojection_cost.h"

#include <Eigen/Geometry>

namespace corvo {
namespace {

using PoseJacobian = Eigen::Matrix<double, 2, 7, Eigen::RowMajor>;
using PointJacobian = Eigen::Matrix<double, 2, 3, Eigen::RowMajor>;

/// With X = T⁻¹ X_w and T ← T Exp([υ ω]): dX = X × ω - υ, and along the manifold υ = Rᵀ dt and
/// ω = 2 vec(q⁻¹ ⊗ dq).
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

ReprojectionCost::ReprojectionCost(const Camera& camera, const Eigen::Vector2d& pixel,
                                   double sigma_px)
    : camera_(camera), pixel_(pixel), sigma_px_(sigma_px) {}

bool ReprojectionCost::Evaluate(const double* const* parameters, double* residuals,
                                double** jacobians) const {
  const Eigen::Map<const Eigen::Quaterniond> quaternion(parameters[0]);
  const Eigen::Map<const Eigen::Vector3d> translation(parameters[0] + 4);
  const Eigen::Map<const Eigen::Vector3d> in_world(parameters[1]);
  const Eigen::Matrix3d camera_from_world = quaternion.toRotationMatrix().transpose();
  const Eigen::Vector3d in_camera = camera_from_world * (in_world - translation);
  Camera::Jacobian by_camera_point;
  const std::optional<Eigen::Vector2d> projected =
      camera_.Project(in_camera, jacobians != nullptr ? &by_camera_point : nullptr);
  if (!projected) return false;
  Eigen::Map<Eigen::Vector2d>{residuals} = (*projected - pixel_) / sigma_px_;
  if (jacobians == nullptr) return true;
  by_camera_point /= sigma_px_;
  const PointJacobian by_world_point = by_camera_point * camera_from_world;
  if (jacobians[0] != nullptr) {
    Eigen::Map<PoseJacobian>{jacobians[0]} =
        ComputePoseJacobian(by_camera_point, by_world_point, in_camera, quaternion);
  }
  if (jacobians[1] != nullptr) Eigen::Map<PointJacobian>{jacobians[1]} = by_world_point;
  return true;
}

}  // namespace corvo
