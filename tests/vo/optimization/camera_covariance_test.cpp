// SPDX-License-Identifier: MIT
#include "vo/optimization/camera_covariance.h"

#include <gmock/gmock.h>

#include <limits>
#include <vector>

#include "tests/support/matchers.h"
#include "tests/vo/optimization/observed_bundle.h"

namespace corvo {
namespace {

/// Returns what all points of the bundles tell of the camera, linearized at a difference.
CameraInformation InformationAt(const Eigen::VectorXd& difference, const CameraPrior& prior,
                                std::vector<Bundle> bundles) {
  AdjustmentState state{bundles, {}, difference};
  for (const Bundle& bundle : bundles) state.is_joint.emplace_back(bundle.points.size(), 1);
  return ObservedInformation(prior, state);
}

/// Returns the covariance at the given camera, using all points of the bundles.
Eigen::MatrixXd CovarianceOf(const CameraPrior& prior, const std::vector<Bundle>& bundles) {
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(prior.num_free());
  return CameraCovariance(prior, InformationAt(none, prior, bundles).matrix);
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

TEST(CameraCovarianceTest, TheNormalEquationsYieldTheTrueCameraFromAnyOtherNearby) {
  test::Random random(3);
  const CameraPrior prior{test::PinholeCamera().parameters(), {{"focal"}, {"cx"}, {"k1"}}};
  const Eigen::Vector3d truth(0.002, 0.5, 0.004);
  Bundle bundle = test::MakeObservedBundle(Camera(prior.Apply(truth)), 10, 0, random);
  for (int view = 1; view < 10; ++view) {
    SE3::Data& pose = bundle.views[view].local_from_camera;
    pose = (SE3::FromData(pose.data()) * SE3::Exp(random.Vector<6>(1e-3))).data();
  }
  for (Bundle::Point& point : bundle.points) point.in_local += random.Vector<3>(1e-2);
  for (const Eigen::Vector3d& at : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.004, 0, 0)}) {
    const CameraInformation information = InformationAt(at, prior, {bundle});
    const Eigen::Vector3d estimate = information.matrix.ldlt().solve(information.vector);
    EXPECT_THAT(Eigen::Vector3d(estimate.cwiseQuotient(truth)),
                test::IsMatrixNear(Eigen::Vector3d(1, 1, 1), 0.1));
  }
}

}  // namespace
}  // namespace corvo
