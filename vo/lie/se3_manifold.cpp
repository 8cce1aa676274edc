// SPDX-License-Identifier: MIT
#include "vo/lie/se3_manifold.h"

#include <Eigen/Core>

#include "vo/lie/se3.h"

namespace corvo {
namespace {

using RowMajor7x6 = Eigen::Matrix<double, 7, 6, Eigen::RowMajor>;
using RowMajor6x7 = Eigen::Matrix<double, 6, 7, Eigen::RowMajor>;

/// Returns d(q ⊗ Exp(ω))/dω at 0, in the order x y z w.
Eigen::Matrix<double, 4, 3> QuaternionPlusJacobian(const SO3& rotation) {
  const Eigen::Quaterniond& q = rotation.quaternion();
  Eigen::Matrix<double, 4, 3> jacobian;
  jacobian.topRows<3>() = 0.5 * (q.w() * Eigen::Matrix3d::Identity() + SO3::Hat(q.vec()));
  jacobian.bottomRows<1>() = -0.5 * q.vec().transpose();
  return jacobian;
}

}  // namespace

bool SE3Manifold::Plus(const double* x, const double* delta, double* x_plus_delta) const {
  const SE3 sum = SE3::FromData(x) * SE3::Exp(Eigen::Map<const SE3::Tangent>(delta));
  Eigen::Map<SE3::Data>(x_plus_delta, 7) = sum.data();
  return true;
}

bool SE3Manifold::PlusJacobian(const double* x, double* jacobian) const {
  const SE3 pose = SE3::FromData(x);
  Eigen::Map<RowMajor7x6> out(jacobian);
  out.setZero();
  out.topRightCorner<4, 3>() = QuaternionPlusJacobian(pose.rotation());
  out.bottomLeftCorner<3, 3>() = pose.rotation().matrix();
  return true;
}

bool SE3Manifold::Minus(const double* y, const double* x, double* y_minus_x) const {
  Eigen::Map<SE3::Tangent>(y_minus_x, 6) = (SE3::FromData(x).Inverse() * SE3::FromData(y)).Log();
  return true;
}

bool SE3Manifold::MinusJacobian(const double* x, double* jacobian) const {
  const SE3 pose = SE3::FromData(x);
  Eigen::Map<RowMajor6x7> out(jacobian);
  out.setZero();
  out.topRightCorner<3, 3>() = pose.rotation().matrix().transpose();
  out.bottomLeftCorner<3, 4>() = 4 * QuaternionPlusJacobian(pose.rotation()).transpose();
  return true;
}

}  // namespace corvo
