#include "vo/reprojection_cost.h"

#include "vo/lie/se3.h"
#include "vo/lie/se3_manifold.h"

namespace corvo {
namespace {

using PoseJacobian = Eigen::Matrix<double, 2, 7, Eigen::RowMajor>;
using PointJacobian = Eigen::Matrix<double, 2, 3, Eigen::RowMajor>;

/// d r / d pose numbers = (d r / d [υ ω]) (d [υ ω] / d pose numbers), with X = T⁻¹ X_w and
/// T ← T Exp([υ ω]): dX = -υ + X × ω.
PoseJacobian ComputePoseJacobian(const Camera::Jacobian& residual_by_point,
                                 const Eigen::Vector3d& in_camera, const double* pose) {
  Eigen::Matrix<double, 2, 6> by_tangent;
  by_tangent.leftCols<3>() = -residual_by_point;
  by_tangent.rightCols<3>() = residual_by_point * SO3::Hat(in_camera);
  Eigen::Matrix<double, 6, 7, Eigen::RowMajor> tangent_by_pose;
  SE3Manifold().MinusJacobian(pose, tangent_by_pose.data());
  return by_tangent * tangent_by_pose;
}

}  // namespace

ReprojectionCost::ReprojectionCost(const Camera& camera, const Eigen::Vector2d& pixel,
                                   double sigma_px)
    : camera_(camera), pixel_(pixel), sigma_px_(sigma_px) {}

bool ReprojectionCost::Evaluate(const double* const* parameters, double* residuals,
                                double** jacobians) const {
  const SE3 camera_from_world = SE3::FromData(parameters[0]).Inverse();
  const Eigen::Vector3d in_camera =
      camera_from_world * Eigen::Vector3d(Eigen::Map<const Eigen::Vector3d>(parameters[1]));
  Camera::Jacobian pixel_by_point;
  const std::optional<Eigen::Vector2d> projected = camera_.Project(in_camera, &pixel_by_point);
  if (!projected) return false;
  Eigen::Map<Eigen::Vector2d>{residuals} = (*projected - pixel_) / sigma_px_;
  if (jacobians == nullptr) return true;
  const Camera::Jacobian residual_by_point = pixel_by_point / sigma_px_;
  if (jacobians[0] != nullptr) {
    Eigen::Map<PoseJacobian>{jacobians[0]} =
        ComputePoseJacobian(residual_by_point, in_camera, parameters[0]);
  }
  if (jacobians[1] != nullptr) {
    Eigen::Map<PointJacobian>{jacobians[1]} =
        residual_by_point * camera_from_world.rotation().matrix();
  }
  return true;
}

}  // namespace corvo
