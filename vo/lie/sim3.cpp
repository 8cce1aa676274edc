// SPDX-License-Identifier: MIT
#include "vo/lie/sim3.h"

#include <Eigen/LU>
#include <cmath>
#include <sstream>

#include "orb/error.h"

namespace corvo {
namespace {

/// Returns W(M) = ∫₀¹ exp(u M) du = Σ Mᵏ/(k+1)!, from its series for a small M, which is then
/// doubled by W(2M) = W(M) (exp(M) + I)/2 and exp(M) = I + M W(M).
Eigen::Matrix3d ExponentialIntegral(Eigen::Matrix3d m) {
  int doublings = 0;
  for (; m.lpNorm<Eigen::Infinity>() > 0.25; ++doublings) m *= 0.5;
  const Eigen::Matrix3d identity = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d integral = identity;
  for (int k = 14; k >= 2; --k) integral = identity + m * integral / k;
  for (; doublings > 0; --doublings, m *= 2) integral *= identity + 0.5 * m * integral;
  return integral;
}

Eigen::Matrix3d TranslationMap(const Eigen::Vector3d& omega, double sigma) {
  return ExponentialIntegral(SO3::Hat(omega) + sigma * Eigen::Matrix3d::Identity());
}

}  // namespace

Sim3::Sim3(double scale, const SO3& rotation, const Eigen::Vector3d& translation)
    : scale_(scale), rotation_(rotation), translation_(translation) {
  if (!translation.allFinite()) throw Error("translation of a similarity is not finite");
  if (scale > 0 && std::isfinite(scale)) return;
  std::ostringstream message;
  message << "scale of a similarity is " << scale << "; allowed is finite and above 0";
  throw Error(message.str());
}

Sim3::Sim3(const SE3& rigid) : Sim3(1, rigid.rotation(), rigid.translation()) {}

Sim3 Sim3::Exp(const Tangent& tangent) {
  if (!tangent.allFinite()) throw Error("tangent of a similarity is not finite");
  const Eigen::Vector3d omega = tangent.segment<3>(3);
  const double sigma = tangent(6);
  return Sim3(std::exp(sigma), SO3::Exp(omega), TranslationMap(omega, sigma) * tangent.head<3>());
}

Sim3::Tangent Sim3::Log() const {
  const Eigen::Vector3d omega = rotation_.Log();
  const double sigma = std::log(scale_);
  Tangent tangent;
  tangent << TranslationMap(omega, sigma).inverse() * translation_, omega, sigma;
  return tangent;
}

Sim3 Sim3::Inverse() const {
  const SO3 inverse = rotation_.Inverse();
  return Sim3(1 / scale_, inverse, -(inverse * translation_) / scale_);
}

Sim3 Sim3::operator*(const Sim3& right) const {
  return Sim3(scale_ * right.scale_, rotation_ * right.rotation_, *this * right.translation_);
}

Eigen::Matrix4d Sim3::matrix() const {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = scale_ * rotation_.matrix();
  matrix.topRightCorner<3, 1>() = translation_;
  return matrix;
}

Sim3::Matrix7 Sim3::Adjoint() const {
  const Eigen::Matrix3d rotation = rotation_.matrix();
  Matrix7 adjoint = Matrix7::Identity();
  adjoint.topLeftCorner<3, 3>() = scale_ * rotation;
  adjoint.block<3, 3>(0, 3) = SO3::Hat(translation_) * rotation;
  adjoint.topRightCorner<3, 1>() = -translation_;
  adjoint.block<3, 3>(3, 3) = rotation;
  return adjoint;
}

bool Sim3::operator==(const Sim3& other) const {
  return scale_ == other.scale_ && rotation_ == other.rotation_ &&
         translation_ == other.translation_;
}

SE3 TransformPose(const Sim3& b_from_a, const SE3& a_from_c) {
  return SE3(b_from_a.rotation() * a_from_c.rotation(), b_from_a * a_from_c.translation());
}

}  // namespace corvo
