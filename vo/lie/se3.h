// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "vo/lie/so3.h"

namespace corvo {

/// A rigid transform:
///
///     x_in_b = b_from_a * x_in_a = rotation * x_in_a + translation
///
/// The tangent is [υ ω], translation first (m or the unit of the scene; rad). Laws, for transforms
/// T, S and a tangent ξ:
///
///     T * T.Inverse() = identity           Exp(T.Log()) = T
///     (T * S) * x = T * (S * x)            T * Exp(ξ) * T.Inverse() = Exp(T.Adjoint() * ξ)
///     Exp(ξ + d) ≈ Exp(LeftJacobian(ξ) * d) * Exp(ξ) ≈ Exp(ξ) * Exp(LeftJacobian(-ξ) * d)
class SE3 {
 public:
  using Tangent = Eigen::Matrix<double, 6, 1>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  using Data = Eigen::Matrix<double, 7, 1>;

  /// Constructs the identity.
  SE3() = default;
  SE3(const SO3& rotation, const Eigen::Vector3d& translation)
      : rotation_(rotation), translation_(translation) {}

  /// Constructs a transform from [qx qy qz qw tx ty tz] and normalizes the quaternion. Throws
  /// corvo::Error as SO3 does.
  static SE3 FromData(const double* data);
  /// Returns [qx qy qz qw tx ty tz].
  Data data() const;

  /// Returns (Exp(ω), J υ) with J = SO3::LeftJacobian(ω).
  static SE3 Exp(const Tangent& tangent);
  Tangent Log() const;

  SE3 Inverse() const;
  /// Returns Exp(exponent Log(this)): the same motion at constant velocity, `exponent` times as
  /// long.
  SE3 Power(double exponent) const { return Exp(exponent * Log()); }
  SE3 operator*(const SE3& right) const;
  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const {
    return rotation_ * point + translation_;
  }

  const SO3& rotation() const { return rotation_; }
  const Eigen::Vector3d& translation() const { return translation_; }
  /// Returns [R t; 0 1].
  Eigen::Matrix4d matrix() const;
  /// Returns [R Hat(t)R; 0 R].
  Matrix6 Adjoint() const;

  /// Returns [J Q; 0 J], J = SO3::LeftJacobian(ω); Q as in Barfoot, State Estimation for Robotics,
  /// eq. 7.86b.
  static Matrix6 LeftJacobian(const Tangent& tangent);
  /// Returns [J⁻¹ -J⁻¹QJ⁻¹; 0 J⁻¹], for |ω| < 2π.
  static Matrix6 LeftJacobianInverse(const Tangent& tangent);

  /// Returns whether the stored numbers are equal.
  bool operator==(const SE3& other) const;

 private:
  SO3 rotation_;
  Eigen::Vector3d translation_ = Eigen::Vector3d::Zero();
};

}  // namespace corvo
