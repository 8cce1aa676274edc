// SPDX-License-Identifier: MIT
#include "vo/optimization/keyframe_innovations.h"

#include <gmock/gmock.h>

#include <vector>

#include "tests/support/matchers.h"
#include "tests/support/random.h"

namespace corvo {
namespace {

constexpr int kNumKeyframes = 6;

/// Returns a path that bends, in units of `unit`.
std::vector<SE3> PathInUnits(double unit) {
  std::vector<SE3> path;
  for (int i = 0; i < kNumKeyframes; ++i) {
    path.emplace_back(SO3::Exp({0.02 * i, 0.1 * i, 0}),
                      unit * Eigen::Vector3d(0.05 * i * i, 0.1 * i, 1.2 * i));
  }
  return path;
}

/// Returns how an infinitesimal similarity about the position of `center` moves a keyframe: a row
/// for each of its degrees of freedom, a column for each of [shift turn stretch].
Eigen::Matrix<double, 6, 7> ByMotion(const SE3& center, const SE3& keyframe) {
  const Eigen::Vector3d arm = keyframe.translation() - center.translation();
  const Eigen::Matrix3d turned = keyframe.rotation().matrix().transpose();
  Eigen::Matrix<double, 6, 7> moved = Eigen::Matrix<double, 6, 7>::Zero();
  moved.topLeftCorner<3, 3>() = turned;
  moved.block<3, 3>(0, 3) = -turned * SO3::Hat(arm);
  moved.topRightCorner<3, 1>() = turned * arm;
  moved.block<3, 3>(3, 3) = turned;
  return moved;
}

/// A window in which the innovation of each keyframe moves all that follow by a similarity.
struct Window {
  explicit Window(double unit) : path(PathInUnits(unit)) {
    test::Random random(3);
    Eigen::MatrixXd factor = Eigen::MatrixXd::Zero(6 * kNumKeyframes, 6 * kNumKeyframes);
    for (int j = 0; j < kNumKeyframes; ++j) {
      covariance.keyframes.push_back(10 + j);
      Eigen::Matrix<double, 7, 6> motion;  // Per innovation.
      for (int i = 0; i < motion.size(); ++i) motion(i) = 0.01 * random.Gaussian();
      motion.topRows<3>() *= unit;
      stretches.push_back(motion.row(6));
      for (int i = j; i < kNumKeyframes; ++i) {
        factor.block<6, 6>(6 * i, 6 * j) = ByMotion(path[j], path[i]) * motion;
      }
    }
    covariance.matrix = factor * factor.transpose();
    covariance.by_camera = factor * Eigen::MatrixXd::Ones(6 * kNumKeyframes, 2);
  }

  std::vector<SE3> path;
  std::vector<Eigen::RowVectorXd> stretches;
  KeyframeCovariance covariance;
};

TEST(KeyframeInnovationsTest, TheirSquaresAreTheCovarianceOfRelativePoses) {
  const Window window(1);
  const KeyframeInnovations innovations(window.covariance, window.path);
  const KeyframeInnovations::Matrix7X error = innovations.ByInnovations(1, 2);
  const SE3::Matrix6 adjoint = (window.path[2].Inverse() * window.path[1]).Adjoint();
  const SE3::Matrix6 both = adjoint * window.covariance.Block(1, 2);
  const SE3::Matrix6 expected = window.covariance.Block(2, 2) - both - both.transpose() +
                                adjoint * window.covariance.Block(1, 1) * adjoint.transpose();
  const SE3::Matrix6 squares = error.topRows<6>() * error.topRows<6>().transpose();
  EXPECT_THAT(squares, test::IsMatrixNear(expected, 1e-9 * expected.norm()));
}

TEST(KeyframeInnovationsTest, TheScaleIsThatOfTheSimilarityOfWhatFollows) {
  const Window window(1);
  const KeyframeInnovations innovations(window.covariance, window.path);
  const KeyframeInnovations::Matrix7X error = innovations.ByInnovations(0, 2);
  double variance = 0;
  for (const int j : {1, 2}) variance += window.stretches[j].squaredNorm();
  EXPECT_NEAR(error.row(6).squaredNorm(), variance, 1e-5 * variance);
  EXPECT_EQ(error.row(6).head<6>().norm(), 0) << "what moves both keyframes";
}

TEST(KeyframeInnovationsTest, TheScaleOfSeveralStepsIsTheSumOfThose) {
  const Window window(1);
  const KeyframeInnovations innovations(window.covariance, window.path);
  const Eigen::MatrixXd steps =
      innovations.ByInnovations(0, 1).row(6) + innovations.ByInnovations(1, 2).row(6);
  EXPECT_THAT(Eigen::MatrixXd(innovations.ByInnovations(0, 2).row(6)),
              test::IsMatrixNear(steps, 1e-12));
}

TEST(KeyframeInnovationsTest, TheCameraMovesKeyframesAsTheCovarianceSays) {
  const Window window(1);
  const KeyframeInnovations innovations(window.covariance, window.path);
  const KeyframeInnovations::Matrix7X error = innovations.ByCamera(innovations.ByInnovations(1, 2));
  const SE3::Matrix6 adjoint = (window.path[2].Inverse() * window.path[1]).Adjoint();
  const Eigen::MatrixXd expected =
      window.covariance.ByCamera(2) - adjoint * window.covariance.ByCamera(1);
  EXPECT_THAT(Eigen::MatrixXd(error.topRows<6>()), test::IsMatrixNear(expected, 1e-9));
}

TEST(KeyframeInnovationsTest, TheScaleHasNoUnitOfLength) {
  const Window window(1), scaled(7);
  const auto error = KeyframeInnovations(window.covariance, window.path).ByInnovations(0, 2);
  const auto other = KeyframeInnovations(scaled.covariance, scaled.path).ByInnovations(0, 2);
  EXPECT_NEAR(error.row(6).norm(), other.row(6).norm(), 1e-5 * error.row(6).norm());
}

TEST(KeyframeInnovationsTest, TheScaleOfTheNewestKeyframesIsNotKnown) {
  const Window window(1);
  const KeyframeInnovations innovations(window.covariance, window.path);
  EXPECT_TRUE(innovations.KnowsScale(kNumKeyframes - 4));
  EXPECT_FALSE(innovations.KnowsScale(kNumKeyframes - 3));
  EXPECT_EQ(innovations.ByInnovations(kNumKeyframes - 3, kNumKeyframes - 1).row(6).norm(), 0);
}

}  // namespace
}  // namespace corvo
