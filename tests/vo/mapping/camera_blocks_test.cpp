// SPDX-License-Identifier: MIT
#include "vo/mapping/camera_blocks.h"

#include <gmock/gmock.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "tests/support/matchers.h"
#include "tests/support/point_scene.h"
#include "tests/support/random.h"
#include "vo/math/chi_square.h"

namespace corvo {
namespace {

CameraPrior Prior() {
  return {test::PinholeCamera().parameters(), {{"focal", 0.1}, {"k1", 0.2}, {"k2", 0.3}}};
}

/// Returns what images tell that measure the difference `truth` with Gaussian errors, all larger by
/// a factor than the information states.
CameraInformation Measure(const Eigen::Vector3d& truth, double factor, test::Random& random) {
  Eigen::Matrix3d root;
  for (int i = 0; i < 9; ++i) root(i) = random.Gaussian(30);
  const Eigen::Matrix3d matrix = root * root.transpose() + 100 * Eigen::Matrix3d::Identity();
  const Eigen::Matrix3d covariance = matrix.inverse();
  const Eigen::Vector3d normal(random.Gaussian(factor), random.Gaussian(factor),
                               random.Gaussian(factor));
  const Eigen::Vector3d error = covariance.llt().matrixL() * normal;
  return {matrix, matrix * (truth + error)};
}

Eigen::Vector3d Sigmas(const CameraBlocks& blocks) {
  return blocks.Estimate().covariance.diagonal().cwiseSqrt();
}

TEST(CameraBlocksTest, WithoutABlockTheEstimateIsThePrior) {
  const CameraEstimate estimate = CameraBlocks(Prior(), 1).Estimate();
  EXPECT_THAT(estimate.difference, test::IsMatrixNear(Eigen::Vector3d(0, 0, 0), 0));
  EXPECT_THAT(Sigmas(CameraBlocks(Prior(), 1)),
              test::IsMatrixNear(Eigen::Vector3d(0.1, 0.2, 0.3), 1e-15));
  const CameraBlocks fixed(CameraPrior{test::PinholeCamera().parameters(), {}}, 1);
  EXPECT_EQ(fixed.Estimate().difference.size(), 0);
}

TEST(CameraBlocksTest, InformationAddsUp) {
  // One parameter with a prior of 0 ± 1 and measurements of 2 ± 1 and 3 ± 0.5.
  CameraBlocks blocks({test::PinholeCamera().parameters(), {{"k1", 1}}}, 1);
  const auto information = [](double value, double sigma) {
    const Eigen::MatrixXd matrix = Eigen::MatrixXd::Constant(1, 1, 1 / (sigma * sigma));
    return CameraInformation{matrix, matrix * Eigen::VectorXd::Constant(1, value)};
  };
  blocks.Add(information(2, 1));
  EXPECT_DOUBLE_EQ(blocks.Estimate().difference[0], 1);
  EXPECT_DOUBLE_EQ(blocks.Estimate().covariance(0, 0), 0.5);
  blocks.Add(information(3, 0.5));
  EXPECT_DOUBLE_EQ(blocks.Estimate().difference[0], (0 + 2 + 4 * 3) / 6.0);
  EXPECT_DOUBLE_EQ(blocks.Estimate().covariance(0, 0), 1 / 6.0);
}

TEST(CameraBlocksTest, AParameterKeepsItsValueWithoutVeryStrongEvidence) {
  // A parameter of 0 ± 1 is measured as `value` ± 0.1: the logarithm of the likelihood ratio is
  // (100 value)² / 101 / 2 - log(101) / 2, which is 5 for a value of 0.3842.
  const auto estimate = [](double value) {
    CameraBlocks blocks({test::PinholeCamera().parameters(), {{"k1", 1}, {"p1", 1, true}}}, 1);
    const Eigen::Matrix2d matrix = Eigen::Vector2d(100, 100).asDiagonal();
    blocks.Add({matrix, matrix * Eigen::Vector2d(0.001, value)});
    return blocks.Estimate();
  };
  EXPECT_EQ(estimate(0.38).difference[1], 0);
  EXPECT_DOUBLE_EQ(estimate(0.39).difference[1], 100 * 0.39 / 101);
  EXPECT_DOUBLE_EQ(estimate(0.38).difference[0], 0.1 / 101) << "needs no evidence";
  EXPECT_DOUBLE_EQ(estimate(0.38).covariance(1, 1), 1 / 101.0) << "is not exact, though";
}

TEST(CameraBlocksTest, OnlyTheStatedShareOfTheInformationCountsInTheCovariance) {
  CameraBlocks blocks({test::PinholeCamera().parameters(), {{"k1", 1}}}, 0.5);
  blocks.Add({Eigen::MatrixXd::Constant(1, 1, 4), Eigen::VectorXd::Constant(1, 10)});
  EXPECT_DOUBLE_EQ(blocks.Estimate().difference[0], 10 / 5.0);
  EXPECT_DOUBLE_EQ(blocks.Estimate().covariance(0, 0), 1 / 3.0);
}

TEST(CameraBlocksTest, BlocksThatAgreeNeverMakeAParameterLessCertain) {
  test::Random random(1);
  CameraBlocks blocks(Prior(), 1);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d before = Sigmas(blocks);
    blocks.Add(Measure({0.05, -0.1, 0.2}, 1, random));
    ASSERT_TRUE(blocks.Estimate().is_consistent) << i;
    EXPECT_TRUE((Sigmas(blocks).array() < before.array()).all()) << i;
  }
  EXPECT_THAT(blocks.Estimate().difference,
              test::IsMatrixNear(Eigen::Vector3d(0.05, -0.1, 0.2), 5 * Sigmas(blocks).maxCoeff()));
}

TEST(CameraBlocksTest, BlocksThatDisagreeInflateTheCovariance) {
  test::Random random(2);
  CameraBlocks zoomed(Prior(), 1);
  for (int i = 0; i < 4; ++i) zoomed.Add(Measure({i < 2 ? 0.0 : 0.2, 0, 0}, 1, random));
  EXPECT_FALSE(zoomed.Estimate().is_consistent);
  // Errors of four times the stated ones: the covariance is 16 times that of the information.
  CameraBlocks blocks(Prior(), 1);
  Eigen::Matrix3d information =
      Eigen::Vector3d(0.1, 0.2, 0.3).cwiseAbs2().cwiseInverse().asDiagonal();
  for (int i = 0; i < 300; ++i) {
    const CameraInformation block = Measure({0, 0, 0}, 4, random);
    information += block.matrix;
    blocks.Add(block);
  }
  EXPECT_FALSE(blocks.Estimate().is_consistent);
  const Eigen::Matrix3d ratio = blocks.Estimate().covariance * information;
  EXPECT_THAT(ratio, test::IsMatrixNear(Eigen::Matrix3d(16 * Eigen::Matrix3d::Identity()), 2));
}

TEST(CameraBlocksTest, BlocksWithErrorsAsStatedAreRarelyFoundToDisagree) {
  test::Random random(3);
  int num_inconsistent = 0;
  for (int i = 0; i < 1000; ++i) {
    CameraBlocks blocks(Prior(), 1);
    for (int block = 0; block < 5; ++block) blocks.Add(Measure({0.1, 0.1, 0.1}, 1, random));
    num_inconsistent += !blocks.Estimate().is_consistent;
  }
  EXPECT_LE(num_inconsistent, 5);  // 1 expected.
}

TEST(CameraBlocksTest, ABlockThatDoesNotDetermineAParameterDoesNotDisagreeAboutIt) {
  CameraBlocks blocks(Prior(), 1);
  test::Random random(4);
  blocks.Add(Measure({0.1, 0, 0}, 1, random));
  Eigen::Matrix3d only_k1 = Eigen::Matrix3d::Zero();
  only_k1(1, 1) = 100;
  blocks.Add({only_k1, Eigen::Vector3d::Zero()});
  EXPECT_TRUE(blocks.Estimate().is_consistent);
  EXPECT_TRUE(blocks.Estimate().covariance.allFinite());
}

TEST(ChiSquare999, AgreesWithTheExactQuantiles) {
  for (int dof = 1; dof <= 12; ++dof) {
    EXPECT_NEAR(ChiSquare999(dof), kChiSquare999[dof], 0.04 * kChiSquare999[dof]) << dof;
  }
  EXPECT_NEAR(ChiSquare999(100), 149.449, 0.1);
}

}  // namespace
}  // namespace corvo
