// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace corvo {

/// A rotation in space, stored as a unit quaternion:
///
///     x_in_b = b_from_a * x_in_a
///
/// Laws, for rotations R, S and a vector ω (rad):
///
///     R * R.Inverse() = identity           Exp(R.Log()) = R           |R.Log()| <= π
///     (R * S) * x = R * (S * x)            R * Exp(ω) * R.Inverse() = Exp(R.Adjoint() * ω)
///     Exp(ω + d) ≈ Exp(LeftJacobian(ω) * d) * Exp(ω) ≈ Exp(ω) * Exp(LeftJacobian(-ω) * d)
class SO3 {
 public:
  using Tangent = Eigen::Vector3d;
  using Matrix = Eigen::Matrix3d;

  /// Constructs the identity.
  SO3() : quaternion_(Eigen::Quaterniond::Identity()) {}
  /// Normalizes the quaternion. Throws corvo::Error if its norm is zero or not finite.
  explicit SO3(const Eigen::Quaterniond& quaternion);
  /// Constructs the rotation of a matrix that is orthonormal up to rounding. Throws corvo::Error if
  /// RᵀR differs from the identity by more than 1e-3 in an entry, or if the matrix is a reflection.
  explicit SO3(const Eigen::Matrix3d& rotation);

  /// Returns the rotation by |ω| rad about ω.
  static SO3 Exp(const Tangent& omega);
  /// Returns the ω of least norm with Exp(ω) = *this; at an angle of π, either of the two.
  Tangent Log() const;

  /// Returns the angle of the rotation, 0 to π rad.
  double Angle() const;
  SO3 Inverse() const;
  SO3 operator*(const SO3& right) const;
  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const { return quaternion_ * point; }

  /// Returns the quaternion, of unit norm up to rounding; q and -q are the same rotation.
  const Eigen::Quaterniond& quaternion() const { return quaternion_; }
  Eigen::Matrix3d matrix() const { return quaternion_.toRotationMatrix(); }
  Eigen::Matrix3d Adjoint() const { return matrix(); }

  /// Returns the matrix with Hat(a) * b = a × b.
  static Eigen::Matrix3d Hat(const Eigen::Vector3d& a);
  /// Returns J = ∫₀¹ Exp(u ω) du = I + (1 - cos θ)/θ² Ω + (θ - sin θ)/θ³ Ω², θ = |ω|, Ω = Hat(ω).
  static Eigen::Matrix3d LeftJacobian(const Tangent& omega);
  /// Returns J⁻¹ = I - Ω/2 + (1 - θ/2 cot(θ/2))/θ² Ω², for θ < 2π.
  static Eigen::Matrix3d LeftJacobianInverse(const Tangent& omega);

  /// Returns whether the stored numbers are equal, which q and -q are not.
  bool operator==(const SO3& other) const;

 private:
  Eigen::Quaterniond quaternion_;
};

}  // namespace corvo
