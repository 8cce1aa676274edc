// SPDX-License-Identifier: MIT
#include "vo/lie/so3.h"

#include <cmath>
#include <sstream>

#include "orb/error.h"
#include "vo/lie/series.h"

namespace corvo {
namespace {

double CheckedNorm(const Eigen::Quaterniond& quaternion) {
  const double norm = quaternion.norm();
  if (norm > 0 && std::isfinite(norm)) return norm;
  std::ostringstream message;
  message << "norm of the rotation quaternion is " << norm << "; allowed is finite and above 0";
  throw Error(message.str());
}

const Eigen::Matrix3d& CheckedRotation(const Eigen::Matrix3d& rotation) {
  const double error =
      (rotation.transpose() * rotation - Eigen::Matrix3d::Identity()).lpNorm<Eigen::Infinity>();
  if (error <= 1e-3 && rotation.determinant() > 0) return rotation;
  std::ostringstream message;
  message << "rotation matrix is not a rotation: RᵀR is " << error
          << " from the identity (allowed is at most 0.001), its determinant "
          << rotation.determinant() << " (allowed is 1)";
  throw Error(message.str());
}

/// Returns sin(θ/2)/θ.
double HalfSinOverAngle(double angle) {
  if (angle > 1e-3) return std::sin(0.5 * angle) / angle;
  return EvenSeries(angle, {0.5, -1.0 / 48, 1.0 / 3840});
}

/// Returns (1 - cos θ)/θ².
double OneMinusCos(double angle) {
  const double ratio = HalfSinOverAngle(angle);
  return 2 * ratio * ratio;
}

/// Returns (1 - θ/2 cot(θ/2))/θ².
double OneMinusHalfCot(double angle) {
  if (angle > kSeriesAngle) {
    return (1 - 0.5 * angle * std::cos(0.5 * angle) / std::sin(0.5 * angle)) / (angle * angle);
  }
  return EvenSeries(angle, {1.0 / 12, 1.0 / 720, 1.0 / 30240, 1.0 / 1209600, 1.0 / 47900160});
}

}  // namespace

SO3::SO3(const Eigen::Quaterniond& quaternion)
    : quaternion_(quaternion.coeffs() / CheckedNorm(quaternion)) {}

SO3::SO3(const Eigen::Matrix3d& rotation) : SO3(Eigen::Quaterniond(CheckedRotation(rotation))) {}

SO3 SO3::Exp(const Tangent& omega) {
  const double angle = omega.norm();
  const Eigen::Vector3d imaginary = HalfSinOverAngle(angle) * omega;
  return SO3(
      Eigen::Quaterniond(std::cos(0.5 * angle), imaginary.x(), imaginary.y(), imaginary.z()));
}

SO3::Tangent SO3::Log() const {
  const double sign = quaternion_.w() < 0 ? -1 : 1;
  const double cosine = sign * quaternion_.w();
  const Eigen::Vector3d imaginary = sign * quaternion_.vec();
  const double sine = imaginary.stableNorm();
  if (sine < 1e-8) return (2 / cosine) * imaginary;
  return (2 * std::atan2(sine, cosine) / sine) * imaginary;
}

double SO3::Angle() const {
  return 2 * std::atan2(quaternion_.vec().stableNorm(), std::abs(quaternion_.w()));
}

SO3 SO3::Inverse() const {
  SO3 inverse;
  inverse.quaternion_ = quaternion_.conjugate();
  return inverse;
}

SO3 SO3::operator*(const SO3& right) const { return SO3(quaternion_ * right.quaternion_); }

Eigen::Matrix3d SO3::Hat(const Eigen::Vector3d& a) {
  Eigen::Matrix3d hat;
  hat << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return hat;
}

Eigen::Matrix3d SO3::LeftJacobian(const Tangent& omega) {
  const double angle = omega.norm();
  const Eigen::Matrix3d hat = Hat(omega);
  return Eigen::Matrix3d::Identity() + OneMinusCos(angle) * hat + AngleMinusSin(angle) * hat * hat;
}

Eigen::Matrix3d SO3::LeftJacobianInverse(const Tangent& omega) {
  const Eigen::Matrix3d hat = Hat(omega);
  return Eigen::Matrix3d::Identity() - 0.5 * hat + OneMinusHalfCot(omega.norm()) * hat * hat;
}

bool SO3::operator==(const SO3& other) const {
  return quaternion_.coeffs() == other.quaternion_.coeffs();
}

}  // namespace corvo
