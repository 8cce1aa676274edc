// SPDX-License-Identifier: MIT
#include "bench/calibration/statistics.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Cholesky>

#include "bench/calibration/learning.h"
#include "tests/support/random.h"

namespace corvo::bench {
namespace {

TEST(NormalizedSquaredErrorTest, IsTheMeanOfSquaredSigmasWithoutCorrelations) {
  const Miss miss{Eigen::Vector2d(1, -6), Eigen::Vector2d(1, 4).asDiagonal()};
  EXPECT_DOUBLE_EQ(NormalizedSquaredError(miss), (1.0 + 9.0) / 2);
}

TEST(NormalizedSquaredErrorTest, ErrorAlongACorrelationCountsLess) {
  Eigen::Matrix2d covariance;
  covariance << 1, 0.8, 0.8, 1;
  const Miss along{Eigen::Vector2d(1, 1), covariance}, across{Eigen::Vector2d(1, -1), covariance};
  EXPECT_DOUBLE_EQ(NormalizedSquaredError(along), 1 / 1.8);
  EXPECT_DOUBLE_EQ(NormalizedSquaredError(across), 1 / 0.2);
}

TEST(JudgeTest, StatisticsAreComputedPerParameter) {
  const Eigen::Matrix2d covariance = Eigen::Vector2d(1, 4).asDiagonal();
  const Consistency consistency =
      Judge({{Eigen::Vector2d(3, 0), covariance}, {Eigen::Vector2d(-4, 5), covariance}});
  EXPECT_EQ(consistency.count, 2);
  EXPECT_EQ(consistency.share_within_3_sigma, Eigen::Vector2d(0.5, 1));
  EXPECT_EQ(consistency.mean_sigma, Eigen::Vector2d(1, 2));
  EXPECT_DOUBLE_EQ(consistency.rms_error[0], std::sqrt((9.0 + 16.0) / 2));
  EXPECT_DOUBLE_EQ(consistency.rms_error[1], std::sqrt(25.0 / 2));
  EXPECT_DOUBLE_EQ(consistency.mean_normalized_squared_error, (9 + 16 + 25.0 / 4) / 4);
}

/// Judges errors drawn from a covariance with correlations; the claimed covariance is `claimed`
/// times as large.
Consistency JudgeDraws(double claimed) {
  test::Random random(7);
  Eigen::Matrix3d covariance;
  covariance << 4, 1, 0.5, 1, 1, -0.3, 0.5, -0.3, 2;
  const Eigen::Matrix3d root = covariance.llt().matrixL();
  std::vector<Miss> misses;
  for (int i = 0; i < 3000; ++i) {
    Eigen::Vector3d normal;
    for (double& entry : normal) entry = random.Gaussian();
    misses.push_back({root * normal, claimed * covariance});
  }
  return Judge(misses);
}

TEST(JudgeTest, ConsistentCovarianceHasNeesOne) {
  const Consistency consistency = JudgeDraws(1);
  EXPECT_NEAR(consistency.mean_normalized_squared_error, 1, 0.05);
  EXPECT_GT(consistency.share_within_3_sigma.minCoeff(), 0.99);
  EXPECT_NEAR(consistency.rms_error[0], consistency.mean_sigma[0], 0.1);
}

TEST(JudgeTest, TooSmallCovarianceHasLargeNees) {
  const Consistency consistency = JudgeDraws(0.25);
  EXPECT_NEAR(consistency.mean_normalized_squared_error, 4, 0.2);
  EXPECT_NEAR(consistency.share_within_3_sigma[1], 0.866, 0.02);  // P(|z| < 1.5), z normal.
}

TEST(FirstFrameWithinTest, IsTheStartOfTheLastRunInsideTheRange) {
  EXPECT_EQ(FirstFrameWithin({0, 2, 5, 2, 3}, 1, 3), 3);
  EXPECT_EQ(FirstFrameWithin({1, 3}, 1, 3), 0);
}

TEST(FirstFrameWithinTest, IsTheNumberOfFramesIfTheLastIsOutside) {
  EXPECT_EQ(FirstFrameWithin({2, 2, 0}, 1, 3), 3);
}

}  // namespace
}  // namespace corvo::bench
