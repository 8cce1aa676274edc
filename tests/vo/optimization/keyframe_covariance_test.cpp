// SPDX-License-Identifier: MIT
#include "vo/optimization/keyframe_covariance.h"

#include <gmock/gmock.h>

#include <vector>

#include "tests/support/data.h"
#include "tests/support/matchers.h"
#include "tests/vo/optimization/observed_bundle.h"
#include "vo/optimization/bundle_adjuster.h"

namespace corvo {
namespace {

constexpr int kNumViews = 5;
constexpr double kKeyframeSigmaPx = 0.5;

Bundle MakeBundle(int num_fixed, test::Random& random) {
  Bundle bundle =
      test::MakeObservedBundle(test::PinholeCamera(), kNumViews, kKeyframeSigmaPx, random);
  for (int view = 0; view < num_fixed; ++view) bundle.views[view].is_fixed = true;
  return bundle;
}

KeyframeCovariance CovarianceOf(const Bundle& bundle) {
  return CovarianceOfViews({test::PinholeCamera().parameters(), {}}, bundle,
                           std::vector<char>(bundle.points.size(), 1));
}

/// Returns the root mean square, over `num_runs` bundles, of the errors of the views' poses after
/// their adjustment, each component in units of its standard deviation.
Eigen::VectorXd ErrorsInSigmas(int num_fixed, int num_runs) {
  AdjustmentOptions options;
  options.huber_sigmas = 100;
  test::Random random(4);
  Eigen::VectorXd sum;
  for (int run = 0; run < num_runs; ++run) {
    const Bundle truth = MakeBundle(num_fixed, random);
    Bundle adjusted = truth;
    EXPECT_TRUE(BundleAdjuster(options).Adjust(test::PinholeCamera(), adjusted).is_usable());
    const KeyframeCovariance covariance = CovarianceOf(truth);
    Eigen::VectorXd errors(covariance.matrix.rows());
    for (int i = 0; i < covariance.size(); ++i) {
      const int view = covariance.keyframes[i];
      errors.segment<6>(6 * i) =
          (adjusted.views[view].Pose().Inverse() * truth.views[view].Pose()).Log();
    }
    if (run == 0) sum = Eigen::VectorXd::Zero(errors.size());
    sum += errors.cwiseAbs2().cwiseQuotient(covariance.matrix.diagonal());
  }
  return (sum / num_runs).cwiseSqrt();
}

TEST(KeyframeCovarianceTest, MatchesTheScatterOfAdjustedPoses) {
  CORVO_SKIP_IF_SHORT();
  const Eigen::VectorXd errors = ErrorsInSigmas(2, 100);
  ASSERT_EQ(errors.size(), 6 * (kNumViews - 2));
  EXPECT_GT(errors.minCoeff(), 0.75);
  EXPECT_LT(errors.maxCoeff(), 1.25);
}

TEST(KeyframeCovarianceTest, WithoutFixedViewsIsRelativeToTheOldestAndTheFarthest) {
  CORVO_SKIP_IF_SHORT();
  const Eigen::VectorXd errors = ErrorsInSigmas(0, 100);
  ASSERT_EQ(errors.size(), 6 * (kNumViews - 1));
  EXPECT_GT(errors.minCoeff(), 0.75);
  EXPECT_LT(errors.maxCoeff(), 1.25);
}

TEST(KeyframeCovarianceTest, TheFarthestViewKeepsItsDistance) {
  test::Random random(5);
  const Bundle bundle = MakeBundle(0, random);
  const SE3 farthest = bundle.views.back().Pose();
  const Eigen::Vector3d direction =
      farthest.rotation().Inverse() * farthest.translation().normalized();
  const KeyframeCovariance covariance = CovarianceOf(bundle);
  const Eigen::Matrix3d translation =
      covariance.matrix.bottomRightCorner<6, 6>().topLeftCorner<3, 3>();
  EXPECT_LT(direction.dot(translation * direction), 1e-3 * translation.trace());
}

TEST(KeyframeCovarianceTest, IsFoundByKeyframe) {
  test::Random random(6);
  const KeyframeCovariance covariance = CovarianceOf(MakeBundle(2, random));
  EXPECT_THAT(covariance.keyframes, ::testing::ElementsAre(2, 3, 4));
  EXPECT_EQ(covariance.Find(3), 1);
  EXPECT_EQ(covariance.Find(1), kNoId);
  EXPECT_EQ(covariance.Find(5), kNoId);
  EXPECT_EQ(covariance.matrix.rows(), 18);
}

TEST(KeyframeCovarianceTest, OtherFramesAreMarginalized) {
  test::Random random(8);
  Bundle bundle = MakeBundle(2, random);
  const CameraPrior camera{test::PinholeCamera().parameters(), {{"focal", 0.01}, {"k1", 0.1}}};
  const std::vector<char> is_joint(bundle.points.size(), 1);
  const KeyframeCovariance of_all = CovarianceOfViews(camera, bundle, is_joint);
  bundle.views.back().keyframe = kNoId;
  const KeyframeCovariance covariance = CovarianceOfViews(camera, bundle, is_joint);
  EXPECT_THAT(covariance.keyframes, ::testing::ElementsAre(2, 3));
  EXPECT_TRUE(covariance.matrix.isApprox(of_all.matrix.topLeftCorner<12, 12>(), 1e-9));
  EXPECT_TRUE(covariance.by_camera.isApprox(of_all.by_camera.topRows<12>(), 1e-9));
  ASSERT_EQ(covariance.landmarks_by_camera.size(), of_all.landmarks_by_camera.size());
  for (const auto& [landmark, by_camera] : of_all.landmarks_by_camera) {
    EXPECT_TRUE(covariance.landmarks_by_camera.at(landmark).isApprox(by_camera, 1e-9)) << landmark;
  }
}

TEST(KeyframeCovarianceTest, OfExactViewsIsEmpty) {
  test::Random random(7);
  EXPECT_EQ(CovarianceOf(MakeBundle(kNumViews, random)).size(), 0);
}

}  // namespace
}  // namespace corvo
