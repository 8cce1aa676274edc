// SPDX-License-Identifier: MIT
#include "vo/lie/so3.h"

#include <gmock/gmock.h>

#include <Eigen/LU>
#include <limits>

#include "tests/support/matchers.h"
#include "tests/support/numeric_jacobian.h"
#include "tests/vo/lie/lie_elements.h"

namespace corvo {
namespace {

using test::AwkwardRotations;
using test::IsMatrixNear;
using test::IsRotationNear;
using test::kPi;
using test::kTinyDeg;
using test::NumericJacobian;
using test::ThrowsError;

constexpr double kTiny = 1e-14;

TEST(SO3Test, DefaultIsIdentity) {
  EXPECT_EQ(SO3().matrix(), Eigen::Matrix3d::Identity());
  EXPECT_EQ(SO3().Log(), Eigen::Vector3d::Zero());
}

TEST(SO3Test, QuarterTurnAboutZTakesXToY) {
  const SO3 turn = SO3::Exp(Eigen::Vector3d(0, 0, 0.5 * kPi));
  EXPECT_THAT(turn * Eigen::Vector3d::UnitX(), IsMatrixNear(Eigen::Vector3d::UnitY(), kTiny));
  EXPECT_NEAR(turn.Angle(), 0.5 * kPi, kTiny);
}

TEST(SO3Test, LogInvertsExp) {
  for (const Eigen::Vector3d& omega : AwkwardRotations()) {
    const Eigen::Vector3d log = SO3::Exp(omega).Log();
    EXPECT_LE(log.norm(), kPi + kTiny);
    const bool half_turn = omega.norm() > kPi - 1e-11;
    const bool flipped = half_turn && log.dot(omega) < 0;
    EXPECT_THAT(flipped ? Eigen::Vector3d(-log) : log, IsMatrixNear(omega, 1e-11))
        << omega.transpose();
    EXPECT_THAT(SO3::Exp(log), IsRotationNear(SO3::Exp(omega), kTinyDeg));
  }
}

TEST(SO3Test, LogKeepsRelativePrecisionOfTinyAngles) {
  for (const double angle : {1e-300, 1e-100, 1e-20, 1e-12, 1e-8, 1e-5}) {
    const Eigen::Vector3d omega = angle * Eigen::Vector3d(1, 2, 2) / 3;
    EXPECT_LE((SO3::Exp(omega).Log() - omega).stableNorm(), 1e-15 * angle);
  }
}

TEST(SO3Test, LogDoesNotDependOnTheSignOfTheQuaternion) {
  for (const Eigen::Vector3d& omega : AwkwardRotations()) {
    if (omega.norm() > kPi - 1e-11) continue;
    Eigen::Quaterniond quaternion = SO3::Exp(omega).quaternion();
    quaternion.coeffs() *= -1;
    EXPECT_THAT(SO3(quaternion).Log(), IsMatrixNear(omega, 1e-11));
  }
}

TEST(SO3Test, LogOfExactHalfTurnHasLengthPi) {
  for (const Eigen::Vector3d& axis : {Eigen::Vector3d(1, 0, 0), Eigen::Vector3d(0, -0.6, 0.8)}) {
    for (const double w : {0.0, -0.0}) {
      const SO3 turn(Eigen::Quaterniond(w, axis.x(), axis.y(), axis.z()));
      EXPECT_THAT(turn.Log(), IsMatrixNear(kPi * axis, kTiny));
    }
  }
}

TEST(SO3Test, ExpAgreesWithAngleAxis) {
  for (const Eigen::Vector3d& omega : AwkwardRotations()) {
    const Eigen::AngleAxisd expected(omega.norm(), omega.stableNormalized());
    EXPECT_THAT(SO3::Exp(omega).matrix(), IsMatrixNear(expected.toRotationMatrix(), kTiny));
  }
}

TEST(SO3Test, MatrixRoundTrips) {
  for (const Eigen::Vector3d& omega : AwkwardRotations()) {
    const SO3 rotation = SO3::Exp(omega);
    EXPECT_THAT(SO3(rotation.matrix()), IsRotationNear(rotation, kTinyDeg));
  }
}

TEST(SO3Test, GroupLawsHold) {
  const Eigen::Vector3d point(3, -1, 2);
  const SO3 fixed = SO3::Exp(Eigen::Vector3d(0.3, -2, 0.7));
  for (const Eigen::Vector3d& omega : AwkwardRotations()) {
    const SO3 rotation = SO3::Exp(omega);
    EXPECT_THAT(rotation * rotation.Inverse(), IsRotationNear(SO3(), kTinyDeg));
    EXPECT_THAT(rotation.Inverse(), IsRotationNear(SO3::Exp(-omega), kTinyDeg));
    EXPECT_THAT((fixed * rotation) * point, IsMatrixNear(fixed * (rotation * point), kTiny));
    EXPECT_THAT((fixed * rotation).matrix(),
                IsMatrixNear(fixed.matrix() * rotation.matrix(), kTiny));
  }
}

TEST(SO3Test, AdjointMovesAPerturbationToTheOtherSide) {
  const Eigen::Vector3d delta(0.1, 0.2, -0.3);
  for (const Eigen::Vector3d& omega : AwkwardRotations()) {
    const SO3 rotation = SO3::Exp(omega);
    EXPECT_THAT(rotation * SO3::Exp(delta) * rotation.Inverse(),
                IsRotationNear(SO3::Exp(rotation.Adjoint() * delta), kTinyDeg));
  }
}

TEST(SO3Test, HatIsTheCrossProduct) {
  const Eigen::Vector3d a(1, 2, 3), b(-4, 5, 0.5);
  EXPECT_EQ(SO3::Hat(a) * b, a.cross(b));
}

TEST(SO3Test, LeftJacobianIsTheDerivativeOfExp) {
  for (const Eigen::Vector3d& omega : AwkwardRotations()) {
    const SO3 inverse = SO3::Exp(omega).Inverse();
    const Eigen::Matrix3d numeric = NumericJacobian<3, 3>(
        [&](const Eigen::Vector3d& delta) { return (SO3::Exp(omega + delta) * inverse).Log(); });
    EXPECT_THAT(SO3::LeftJacobian(omega), IsMatrixNear(numeric, 1e-10)) << omega.transpose();
  }
}

TEST(SO3Test, LeftJacobianInverseInverts) {
  for (const Eigen::Vector3d& omega : AwkwardRotations()) {
    EXPECT_THAT(SO3::LeftJacobianInverse(omega) * SO3::LeftJacobian(omega),
                IsMatrixNear(Eigen::Matrix3d::Identity(), 1e-13));
  }
}

TEST(SO3Test, NormStaysOneOverManyProducts) {
  const SO3 step = SO3::Exp(Eigen::Vector3d(0.1, 0.2, -0.15));
  SO3 rotation;
  for (int i = 0; i < 100000; ++i) rotation = rotation * step;
  EXPECT_NEAR(rotation.quaternion().norm(), 1, 1e-15);
}

TEST(SO3Test, NormalizesQuaternions) {
  const SO3 rotation(Eigen::Quaterniond(0, 0, 3, 4));
  EXPECT_THAT(rotation.quaternion().coeffs(), IsMatrixNear(Eigen::Vector4d(0, 0.6, 0.8, 0), 1e-15));
}

TEST(SO3Test, RejectsInvalidRotations) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT([] { SO3(Eigen::Quaterniond(0, 0, 0, 0)); }, ThrowsError("norm", "0"));
  EXPECT_THAT([&] { SO3(Eigen::Quaterniond(nan, 0, 0, 1)); }, ThrowsError("norm", "nan"));
  EXPECT_THAT([] { SO3(Eigen::Matrix3d(-Eigen::Matrix3d::Identity())); }, ThrowsError("-1"));
  EXPECT_THAT([] { SO3(Eigen::Matrix3d(2 * Eigen::Matrix3d::Identity())); },
              ThrowsError("RᵀR", "3"));
}

}  // namespace
}  // namespace corvo
