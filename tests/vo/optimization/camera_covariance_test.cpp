// SPDX-License-Identifier: MIT
#include "vo/optimization/camera_covariance.h"

#include <gmock/gmock.h>

#include <limits>
#include <vector>

#include "tests/support/matchers.h"
#include "tests/vo/optimization/observed_bundle.h"

namespace corvo {
namespace {

/// Returns the covariance at the given camera, using all points of the bundles.
Eigen::MatrixXd CovarianceOf(const CameraPrior& prior, std::vector<Bundle> bundles) {
  AdjustmentState state{bundles, {}, Eigen::VectorXd::Zero(prior.num_free())};
  for (const Bundle& bundle : bundles) state.is_joint.emplace_back(bundle.points.size(), 1);
  return CameraCovariance(prior, ObservedInformation(prior, state));
}

TEST(CameraCovarianceTest, DuplicatedObservationsHalveTheCovariance) {
  test::Random random(2);
  const CameraPrior prior{test::PinholeCamera().parameters(), {{"focal"}, {"cx"}, {"k1"}}};
  const Bundle bundle = test::MakeObservedBundle(test::PinholeCamera(), 10, 0.5, random);
  const Eigen::MatrixXd once = CovarianceOf(prior, {bundle});
  const Eigen::MatrixXd twice = CovarianceOf(prior, {bundle, bundle});
  ASSERT_TRUE(once.allFinite());
  EXPECT_THAT(Eigen::MatrixXd(twice.cwiseQuotient(once)),
              test::IsMatrixNear(Eigen::Matrix3d(Eigen::Matrix3d::Constant(0.5)), 1e-3));
}

TEST(CameraCovarianceTest, WithoutObservationsTheCovarianceIsThatOfThePrior) {
  const CameraPrior prior{test::PinholeCamera().parameters(),
                          {{"focal", 0.01}, {"k1", 0.02}, {"k2", 0.03}}};
  const Eigen::Vector3d sigmas = CovarianceOf(prior, {Bundle()}).diagonal().cwiseSqrt();
  EXPECT_THAT(sigmas, test::IsMatrixNear(Eigen::Vector3d(0.01, 0.02, 0.03), 1e-12));
  const CameraPrior unknown{prior.given, {{"focal"}}};
  EXPECT_EQ(CovarianceOf(unknown, {})(0, 0), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace corvo
