// SPDX-License-Identifier: MIT
#include "tests/support/numeric_jacobian.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/support/matchers.h"

namespace corvo::test {
namespace {

TEST(NumericJacobianTest, IsExactForPolynomialsOfFourthOrder) {
  const Eigen::Vector2d x(2, -3);
  const auto jacobian = NumericJacobianAt<1, 2>(x, [](const Eigen::Vector2d& v) {
    return Eigen::Matrix<double, 1, 1>(std::pow(v.x(), 4) * v.y());
  });
  EXPECT_THAT(jacobian, IsMatrixNear(Eigen::RowVector2d(4 * 8 * -3, 16), 1e-9));
}

TEST(NumericJacobianTest, DetectsAWrongDerivative) {
  const auto jacobian = NumericJacobian<1, 1>([](const Eigen::Matrix<double, 1, 1>& delta) {
    return Eigen::Matrix<double, 1, 1>(std::sin(1 + delta(0)));
  });
  EXPECT_NEAR(jacobian(0), std::cos(1), 1e-12);
  EXPECT_GT(std::abs(jacobian(0) - (std::cos(1) + 1e-6)), 1e-7);
}

TEST(NumericJacobianTest, PerturbsPosesOnTheRightTranslationFirst) {
  const SE3 quarter_turn(SO3::Exp(Eigen::Vector3d(0, 0, std::acos(0.0))), Eigen::Vector3d(1, 2, 3));
  const auto jacobian =
      NumericJacobianAt<3>(quarter_turn, [](const SE3& pose) { return pose.translation(); });
  Eigen::Matrix<double, 3, 6> expected = Eigen::Matrix<double, 3, 6>::Zero();
  expected.leftCols<3>() = quarter_turn.rotation().matrix();
  EXPECT_THAT(jacobian, IsMatrixNear(expected, 1e-11));
}

}  // namespace
}  // namespace corvo::test
