// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "vo/lie/se3.h"
#include "vo/lie/so3.h"

namespace corvo {

/// A similarity transform:
///
///     x_in_b = b_from_a * x_in_a = scale * (rotation * x_in_a) + translation,   scale > 0
///
/// The tangent is [υ ω σ], σ = log(scale). Laws, for similarities T, S and a tangent ξ:
///
///     T * T.Inverse() = identity           Exp(T.Log()) = T
///     (T * S) * x = T * (S * x)            T * Exp(ξ) * T.Inverse() = Exp(T.Adjoint() * ξ)
class Sim3 {
 public:
  using Tangent = Eigen::Matrix<double, 7, 1>;
  using Matrix7 = Eigen::Matrix<double, 7, 7>;

  /// Constructs the identity.
  Sim3() = default;
  /// Throws corvo::Error unless all numbers are finite and the scale is above 0.
  Sim3(double scale, const SO3& rotation, const Eigen::Vector3d& translation);
  /// Constructs a similarity of scale 1.
  explicit Sim3(const SE3& rigid);

  /// Returns (e^σ, Exp(ω), W υ) with W = ∫₀¹ e^{uσ} Exp(u ω) du.
  static Sim3 Exp(const Tangent& tangent);
  Tangent Log() const;

  Sim3 Inverse() const;
  Sim3 operator*(const Sim3& right) const;
  Eigen::Vector3d operator*(const Eigen::Vector3d& point) const {
    return scale_ * (rotation_ * point) + translation_;
  }

  double scale() const { return scale_; }
  const SO3& rotation() const { return rotation_; }
  const Eigen::Vector3d& translation() const { return translation_; }
  /// Returns [sR t; 0 1].
  Eigen::Matrix4d matrix() const;
  /// Returns [sR Hat(t)R -t; 0 R 0; 0 0 1].
  Matrix7 Adjoint() const;

  /// Returns whether the stored numbers are equal.
  bool operator==(const Sim3& other) const;

 private:
  double scale_ = 1;
  SO3 rotation_;
  Eigen::Vector3d translation_ = Eigen::Vector3d::Zero();
};

/// Returns the pose b_from_c of a rigid frame c whose position is mapped by a similarity: rotations
/// are composed, and the origin of c is b_from_a * (its position in a). Lengths in c take the scale
/// of b.
SE3 TransformPose(const Sim3& b_from_a, const SE3& a_from_c);

}  // namespace corvo
