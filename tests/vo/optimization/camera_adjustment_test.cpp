// SPDX-License-Identifier: MIT
#include "vo/optimization/bundle_adjuster.h"

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "tests/support/data.h"
#include "tests/support/matchers.h"
#include "tests/support/point_scene.h"

namespace corvo {
namespace {

constexpr double kAssumedSigmaPx = 0.5;
constexpr double kObservationNoisePx = 0.3;

enum class Motion { kTurning, kStraight, kTurnInPlace };

SE3 PoseAt(Motion path, int view) {
  switch (path) {
    case Motion::kTurning:
      return {SO3::Exp({0.02 * std::sin(view), 0.06 * view - 0.3, 0.03 * std::cos(view)}),
              {0.4 * view, 0.1 * std::sin(view), 0.3 * view}};
    case Motion::kStraight:
      return {SO3(), {0, 0, 0.5 * view}};
    case Motion::kTurnInPlace:
      break;
  }
  return {SO3::Exp({0, 0.03 * view, 0}), Eigen::Vector3d::Zero()};
}

/// Makes a map of keyframes with true poses and landmarks at true positions, observed by `camera`.
Map MakeViewMap(const Camera& camera, Motion path, test::Random& random) {
  constexpr int kViews = 10;
  const test::PointScene scene = test::MakeBoxScene(600, 6, 30, random);
  std::vector<test::SceneView> views;
  for (int i = 0; i < kViews; ++i) {
    views.push_back(
        test::ObserveScene(scene, camera, PoseAt(path, i), kObservationNoisePx, random));
  }
  return test::MakeMap(scene, views, test::MakeModel(kAssumedSigmaPx));
}

Bundle CopyAll(const Map& map) {
  AdjustmentWindow window;
  for (KeyframeId id = 0; id < map.num_keyframes(); ++id) window.free.push_back(id);
  window.landmarks = map.FindObserved(window.free);
  return CopyBundle(map, window);
}

/// Estimates the camera from a map that was first adjusted with the given camera, like the map of
/// an odometry.
CameraEstimate Estimate(const Eigen::Vector3d& truth, Motion path, CalibrationOptions options,
                        test::Random& random) {
  options.center_sigma_share = options.tangential_sigma = 0;
  const CameraPrior prior = MakePrior(test::PinholeCamera().parameters(), options);
  Bundle bundle = CopyAll(MakeViewMap(Camera(prior.Apply(truth)), path, random));
  BundleAdjuster(WindowAdjustment({})).Adjust(Camera(prior.given), bundle);
  std::vector<Bundle> bundles{bundle};
  const int num_keyframes = static_cast<int>(bundle.views.size());
  const AdjustmentSummary summary = BundleAdjuster(CalibrationAdjustment(options, num_keyframes))
                                        .Adjust(prior, prior.given, bundles);
  EXPECT_TRUE(summary.is_usable()) << ToString(summary.status);
  return summary.estimate;
}

Eigen::Vector3d Sigmas(const CalibrationOptions& options) {
  return {options.focal_sigma, options.k1_sigma, options.k2_sigma};
}

double SquaredNormalizedError(const CameraEstimate& estimate, const Eigen::Vector3d& truth) {
  const Eigen::Vector3d error = estimate.difference - truth;
  return error.dot(estimate.covariance.ldlt().solve(error));
}

CalibrationOptions LooseOptions() {
  CalibrationOptions options;
  options.focal_sigma = 0.01;
  // The errors of these observations are independent, unlike those along the tracks of images.
  options.information_factor = std::pow(kAssumedSigmaPx / kObservationNoisePx, 2);
  options.max_iterations = 30;
  return options;
}

TEST(CameraAdjustmentTest, ATurningCameraDeterminesItsDistortionWithConsistentCovariance) {
  CORVO_SKIP_IF_SHORT();
  const CalibrationOptions options = LooseOptions();
  test::Random random(1);
  constexpr int kRuns = 20;
  double sum = 0;
  for (int run = 0; run < kRuns; ++run) {
    const Eigen::Vector3d truth = Sigmas(options).cwiseProduct(Eigen::Vector3d(random.Vector<3>()));
    const CameraEstimate estimate = Estimate(truth, Motion::kTurning, options, random);
    EXPECT_LT(std::sqrt(estimate.covariance(1, 1)), 0.2 * options.k1_sigma);
    EXPECT_NEAR(estimate.difference[1], truth[1], 4 * std::sqrt(estimate.covariance(1, 1)));
    EXPECT_NEAR(estimate.difference[2], truth[2], 4 * std::sqrt(estimate.covariance(2, 2)));
    sum += SquaredNormalizedError(estimate, truth);
  }
  EXPECT_GT(sum / (3 * kRuns), 0.5);
  EXPECT_LT(sum / (3 * kRuns), 2.0);
}

TEST(CameraAdjustmentTest, DegenerateMotionKeepsThePrior) {
  const CalibrationOptions options = LooseOptions();
  test::Random random(2);
  for (const Motion path : {Motion::kStraight, Motion::kTurnInPlace}) {
    const CameraEstimate estimate = Estimate({0, 0, 0}, path, options, random);
    EXPECT_LT(std::abs(estimate.difference[0]), options.focal_sigma);
    EXPECT_LT(std::abs(estimate.difference[1]), options.k1_sigma);
    EXPECT_LT(std::abs(estimate.difference[2]), options.k2_sigma);
  }
  const CameraEstimate straight = Estimate({0, 0, 0}, Motion::kStraight, options, random);
  EXPECT_GT(std::sqrt(straight.covariance(0, 0)), 0.8 * options.focal_sigma);
}

TEST(CameraAdjustmentTest, ATightPriorKeepsTheGivenCamera) {
  CalibrationOptions options;
  options.focal_sigma = options.k1_sigma = options.k2_sigma = 1e-6;
  test::Random random(3);
  const CameraEstimate estimate = Estimate({0, 0.02, 0}, Motion::kTurning, options, random);
  EXPECT_THAT(Eigen::Vector3d(estimate.difference),
              test::IsMatrixNear(Eigen::Vector3d(0, 0, 0), 1e-5));
}

TEST(CameraAdjustmentTest, ResultIsIdenticalWhenRepeated) {
  const auto estimate = [] {
    test::Random random(4);
    return Estimate({0, 0.02, 0}, Motion::kTurning, LooseOptions(), random);
  };
  const CameraEstimate first = estimate(), second = estimate();
  EXPECT_EQ(first.difference, second.difference);
  EXPECT_EQ(first.covariance, second.covariance);
}

}  // namespace
}  // namespace corvo
