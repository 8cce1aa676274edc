// SPDX-License-Identifier: MIT
#include "vo/math/levenberg_marquardt.h"

#include <gtest/gtest.h>

#include <cmath>

namespace corvo {
namespace {

Eigen::Vector2d Plus(const Eigen::Vector2d& at, const Eigen::Vector2d& step) { return at + step; }

/// Returns the normal equations of Rosenbrock's function: residuals 10 (y - x²) and 1 - x, minimum
/// at (1, 1).
NormalEquations<2> Rosenbrock(const Eigen::Vector2d& at) {
  const Eigen::Vector2d residuals(10 * (at.y() - at.x() * at.x()), 1 - at.x());
  Eigen::Matrix2d jacobian;
  jacobian << -20 * at.x(), 10, -1, 0;
  return {jacobian.transpose() * jacobian, jacobian.transpose() * residuals,
          residuals.squaredNorm()};
}

TEST(LevenbergMarquardtTest, FindsTheMinimumOfRosenbrocksFunction) {
  const auto minimum =
      MinimizeLevenbergMarquardt<2>(Eigen::Vector2d(-1.2, 1), Rosenbrock, Plus, 100);
  EXPECT_NEAR(minimum.state.x(), 1, 1e-4);
  EXPECT_NEAR(minimum.state.y(), 1, 1e-4);
  EXPECT_NEAR(minimum.cost, 0, 1e-6);
}

TEST(LevenbergMarquardtTest, NeverIncreasesTheCost) {
  for (int iterations = 0; iterations < 10; ++iterations) {
    const Eigen::Vector2d start(-1.2, 1);
    const auto fewer = MinimizeLevenbergMarquardt<2>(start, Rosenbrock, Plus, iterations);
    const auto more = MinimizeLevenbergMarquardt<2>(start, Rosenbrock, Plus, iterations + 1);
    EXPECT_LE(more.cost, fewer.cost) << iterations;
  }
}

TEST(LevenbergMarquardtTest, WithoutInformationTheStateIsUnchanged) {
  const auto nothing = [](const Eigen::Vector2d&) { return NormalEquations<2>(); };
  const Eigen::Vector2d start(3, 4);
  EXPECT_EQ(MinimizeLevenbergMarquardt<2>(start, nothing, Plus, 10).state, start);
}

}  // namespace
}  // namespace corvo
