// SPDX-License-Identifier: MIT
#include "vo/lie/se3.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <unsupported/Eigen/MatrixFunctions>

#include "tests/support/matchers.h"
#include "tests/support/numeric_jacobian.h"
#include "tests/vo/lie/lie_elements.h"

namespace corvo {
namespace {

using test::AwkwardMotions;
using test::IsMatrixNear;
using test::IsPoseNear;
using test::kPi;
using test::kTinyDeg;
using test::NumericJacobian;
using test::ThrowsError;

/// Returns the tolerance for rounding errors of a motion's translation.
double Rounding(const SE3::Tangent& motion) {
  return 1e-14 * std::max(1.0, motion.head<3>().norm());
}

/// Returns the series of the adjoint algebra, Σ adⁿ / (n + 1)!.
SE3::Matrix6 SeriesOfLeftJacobian(const SE3::Tangent& motion) {
  SE3::Matrix6 ad;
  ad << SO3::Hat(motion.tail<3>()), SO3::Hat(motion.head<3>()), Eigen::Matrix3d::Zero(),
      SO3::Hat(motion.tail<3>());
  SE3::Matrix6 series = SE3::Matrix6::Identity();
  for (int k = 40; k >= 2; --k) series = SE3::Matrix6::Identity() + ad * series / k;
  return series;
}

TEST(SE3Test, DefaultIsIdentity) { EXPECT_EQ(SE3().matrix(), Eigen::Matrix4d::Identity()); }

TEST(SE3Test, RotatesThenTranslates) {
  const SE3 b_from_a(SO3::Exp(Eigen::Vector3d(0, 0, 0.5 * kPi)), Eigen::Vector3d(10, 20, 30));
  EXPECT_THAT(b_from_a * Eigen::Vector3d(1, 0, 0),
              IsMatrixNear(Eigen::Vector3d(10, 21, 30), 1e-14));
}

TEST(SE3Test, DataIsQuaternionXyzwThenTranslation) {
  const double data[] = {0, 0.6, 0, 0.8, 1, 2, 3};
  const SE3 pose = SE3::FromData(data);
  EXPECT_EQ(pose.rotation().quaternion().y(), 0.6);
  EXPECT_EQ(pose.rotation().quaternion().w(), 0.8);
  EXPECT_EQ(pose.translation(), Eigen::Vector3d(1, 2, 3));
  EXPECT_THAT(pose.data(), IsMatrixNear(Eigen::Map<const SE3::Data>(data, 7), 1e-16));
}

TEST(SE3Test, LogInvertsExp) {
  for (const SE3::Tangent& motion : AwkwardMotions()) {
    const SE3 pose = SE3::Exp(motion);
    EXPECT_THAT(SE3::Exp(pose.Log()), IsPoseNear(pose, kTinyDeg, 10 * Rounding(motion)));
    if (motion.tail<3>().norm() > kPi - 1e-11) continue;
    EXPECT_THAT(pose.Log(), IsMatrixNear(motion, 1e-11 + 1e3 * Rounding(motion)));
  }
}

TEST(SE3Test, ExpIsTheMatrixExponential) {
  for (const SE3::Tangent& motion : AwkwardMotions()) {
    if (motion.head<3>().norm() > 1e3) continue;  // Eigen's exp() loses digits here.
    Eigen::Matrix4d hat = Eigen::Matrix4d::Zero();
    hat.topLeftCorner<3, 3>() = SO3::Hat(motion.tail<3>());
    hat.topRightCorner<3, 1>() = motion.head<3>();
    EXPECT_THAT(SE3::Exp(motion).matrix(), IsMatrixNear(hat.exp(), 100 * Rounding(motion)));
  }
}

TEST(SE3Test, GroupLawsHold) {
  const Eigen::Vector3d point(3, -1, 2);
  const SE3 fixed = SE3::Exp((SE3::Tangent() << 1, 2, 3, 0.3, -2, 0.7).finished());
  for (const SE3::Tangent& motion : AwkwardMotions()) {
    const SE3 pose = SE3::Exp(motion);
    const double rounding = 10 * Rounding(motion);
    EXPECT_THAT(pose * pose.Inverse(), IsPoseNear(SE3(), kTinyDeg, rounding));
    EXPECT_THAT(pose.Inverse(), IsPoseNear(SE3::Exp(-motion), kTinyDeg, rounding));
    EXPECT_THAT((fixed * pose) * point, IsMatrixNear(fixed * (pose * point), rounding));
    EXPECT_THAT((fixed * pose).matrix(), IsMatrixNear(fixed.matrix() * pose.matrix(), rounding));
  }
}

TEST(SE3Test, PowersRepeatTheMotion) {
  const SE3 motion = SE3::Exp({0.3, -0.2, 1, 0.4, 0.1, -0.3});
  EXPECT_THAT(motion.Power(0), IsPoseNear(SE3(), kTinyDeg, 1e-14));
  EXPECT_THAT(motion.Power(3), IsPoseNear(motion * motion * motion, kTinyDeg, 1e-13));
  EXPECT_THAT(motion.Power(-1), IsPoseNear(motion.Inverse(), kTinyDeg, 1e-14));
  EXPECT_THAT(motion.Power(0.25) * motion.Power(0.75), IsPoseNear(motion, kTinyDeg, 1e-14));
}

TEST(SE3Test, AdjointMovesAPerturbationToTheOtherSide) {
  const SE3::Tangent delta = (SE3::Tangent() << 0.4, -0.5, 0.6, 0.1, 0.2, -0.3).finished();
  for (const SE3::Tangent& motion : AwkwardMotions()) {
    const SE3 pose = SE3::Exp(motion);
    EXPECT_THAT(pose * SE3::Exp(delta) * pose.Inverse(),
                IsPoseNear(SE3::Exp(pose.Adjoint() * delta), kTinyDeg, 10 * Rounding(motion)));
  }
}

TEST(SE3Test, LeftJacobianIsTheDerivativeOfExp) {
  for (const SE3::Tangent& motion : AwkwardMotions()) {
    const double scale = std::max(1.0, motion.head<3>().norm());
    const SE3 inverse = SE3::Exp(motion).Inverse();
    const SE3::Matrix6 numeric = NumericJacobian<6, 6>(
        [&](const SE3::Tangent& delta) { return (SE3::Exp(motion + delta) * inverse).Log(); });
    EXPECT_THAT(SE3::LeftJacobian(motion), IsMatrixNear(numeric, 1e-10 * scale))
        << motion.transpose();
  }
}

TEST(SE3Test, LeftJacobianAgreesWithTheSeriesOfTheAdjointAlgebra) {
  for (const SE3::Tangent& motion : AwkwardMotions()) {
    EXPECT_THAT(SE3::LeftJacobian(motion),
                IsMatrixNear(SeriesOfLeftJacobian(motion), 10 * Rounding(motion)));
  }
}

TEST(SE3Test, LeftJacobianIsExactToRoundingWhereItIsASeries) {
  test::Random random(3);
  for (int i = 0; i < 100; ++i) {
    SE3::Tangent motion;
    motion << random.Direction(), 0.2999 * random.Direction();
    EXPECT_THAT(SE3::LeftJacobian(motion), IsMatrixNear(SeriesOfLeftJacobian(motion), 1e-15));
  }
}

TEST(SE3Test, LeftJacobianInverseInverts) {
  for (const SE3::Tangent& motion : AwkwardMotions()) {
    EXPECT_THAT(SE3::LeftJacobianInverse(motion) * SE3::LeftJacobian(motion),
                IsMatrixNear(SE3::Matrix6::Identity(), 100 * Rounding(motion)));
  }
}

TEST(SE3Test, RightPerturbationOfAPointHasTheTextbookDerivative) {
  const Eigen::Vector3d point(1, -2, 5);
  for (const SE3::Tangent& motion : AwkwardMotions()) {
    if (motion.head<3>().norm() > 1e3) continue;
    const SE3 pose = SE3::Exp(motion);
    Eigen::Matrix<double, 3, 6> analytic;
    analytic << pose.rotation().matrix(), -pose.rotation().matrix() * SO3::Hat(point);
    const Eigen::Matrix<double, 3, 6> numeric =
        test::NumericJacobianAt<3>(pose, [&](const SE3& moved) { return moved * point; });
    EXPECT_THAT(analytic, IsMatrixNear(numeric, 1e-9));
  }
}

TEST(SE3Test, RejectsAZeroQuaternion) {
  const double data[] = {0, 0, 0, 0, 1, 2, 3};
  EXPECT_THAT([&] { SE3::FromData(data); }, ThrowsError("quaternion"));
}

}  // namespace
}  // namespace corvo
