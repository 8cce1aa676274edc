// SPDX-License-Identifier: MIT
#include "vo/lie/se3.h"

#include <cmath>

#include "vo/lie/series.h"

namespace corvo {
namespace {

/// Returns (θ²/2 + cos θ - 1)/θ⁴.
double CosRemainder(double angle) {
  if (angle > kSeriesAngle) {
    const double square = angle * angle;
    return (0.5 * square + std::cos(angle) - 1) / (square * square);
  }
  return EvenSeries(angle, {1.0 / 24, -1.0 / 720, 1.0 / 40320, -1.0 / 3628800, 1.0 / 479001600});
}

/// Returns (θ - 3/2 sin θ + θ/2 cos θ)/θ⁵.
double SinCosRemainder(double angle) {
  if (angle > kSeriesAngle) {
    const double square = angle * angle;
    return (angle - 1.5 * std::sin(angle) + 0.5 * angle * std::cos(angle)) /
           (square * square * angle);
  }
  return EvenSeries(angle,
                    {1.0 / 120, -2.0 / 5040, 3.0 / 362880, -4.0 / 39916800, 5.0 / 6227020800});
}

/// Returns the upper right block of the left Jacobian.
Eigen::Matrix3d JacobianQ(const SE3::Tangent& tangent) {
  const Eigen::Matrix3d p = SO3::Hat(tangent.head<3>());
  const Eigen::Matrix3d w = SO3::Hat(tangent.tail<3>());
  const double angle = tangent.tail<3>().norm();
  const Eigen::Matrix3d wp = w * p, pw = p * w, wpw = wp * w;
  return 0.5 * p + AngleMinusSin(angle) * (wp + pw + wpw) +
         CosRemainder(angle) * (w * wp + pw * w - 3 * wpw) +
         SinCosRemainder(angle) * (wpw * w + w * wpw);
}

/// Returns [diagonal corner; 0 diagonal].
SE3::Matrix6 UpperBlocks(const Eigen::Matrix3d& diagonal, const Eigen::Matrix3d& corner) {
  SE3::Matrix6 blocks;
  blocks << diagonal, corner, Eigen::Matrix3d::Zero(), diagonal;
  return blocks;
}

}  // namespace

SE3 SE3::FromData(const double* data) {
  return SE3(SO3(Eigen::Quaterniond(data[3], data[0], data[1], data[2])),
             Eigen::Vector3d(data[4], data[5], data[6]));
}

SE3::Data SE3::data() const {
  Data data;
  data << rotation_.quaternion().coeffs(), translation_;
  return data;
}

SE3 SE3::Exp(const Tangent& tangent) {
  const Eigen::Vector3d omega = tangent.tail<3>();
  return SE3(SO3::Exp(omega), SO3::LeftJacobian(omega) * tangent.head<3>());
}

SE3::Tangent SE3::Log() const {
  const Eigen::Vector3d omega = rotation_.Log();
  Tangent tangent;
  tangent << SO3::LeftJacobianInverse(omega) * translation_, omega;
  return tangent;
}

SE3 SE3::Inverse() const {
  const SO3 inverse = rotation_.Inverse();
  return SE3(inverse, -(inverse * translation_));
}

SE3 SE3::operator*(const SE3& right) const {
  return SE3(rotation_ * right.rotation_, *this * right.translation_);
}

Eigen::Matrix4d SE3::matrix() const {
  Eigen::Matrix4d matrix = Eigen::Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = rotation_.matrix();
  matrix.topRightCorner<3, 1>() = translation_;
  return matrix;
}

SE3::Matrix6 SE3::Adjoint() const {
  const Eigen::Matrix3d rotation = rotation_.matrix();
  return UpperBlocks(rotation, SO3::Hat(translation_) * rotation);
}

SE3::Matrix6 SE3::LeftJacobian(const Tangent& tangent) {
  return UpperBlocks(SO3::LeftJacobian(tangent.tail<3>()), JacobianQ(tangent));
}

SE3::Matrix6 SE3::LeftJacobianInverse(const Tangent& tangent) {
  const Eigen::Matrix3d inverse = SO3::LeftJacobianInverse(tangent.tail<3>());
  return UpperBlocks(inverse, -inverse * JacobianQ(tangent) * inverse);
}

bool SE3::operator==(const SE3& other) const {
  return rotation_ == other.rotation_ && translation_ == other.translation_;
}

}  // namespace corvo
