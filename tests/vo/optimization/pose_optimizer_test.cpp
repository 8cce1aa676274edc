// SPDX-License-Identifier: MIT
#include "vo/optimization/pose_optimizer.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/support/matchers.h"
#include "tests/support/point_scene.h"
#include "vo/optimization/reprojection_error.h"

namespace corvo {
namespace {

const SE3 kTruth(SO3::Exp({0.1, -0.2, 0.05}), Eigen::Vector3d(0.3, -0.1, 0.2));

PoseObservations Observe(int num_points, double sigma_px, test::Random& random) {
  const test::PointScene scene = test::MakeBoxScene(num_points, 2, 10, random);
  const Camera camera = test::PinholeCamera();
  const test::SceneView view = test::ObserveScene(scene, camera, kTruth, sigma_px, random);
  PoseObservations observations;
  for (int k = 0; k < view.frame.num_keypoints(); ++k) {
    observations.Add({scene.in_world[view.points[k]]}, {kNoId, k, view.frame.pixel(k), 1.0});
  }
  return observations;
}

TEST(PoseOptimizerTest, FindsTheExactPose) {
  test::Random random(1);
  const auto observations = Observe(100, 0, random);
  const SE3 initial = kTruth * SE3::Exp(random.Vector<6>(0.1));
  const PoseEstimate estimate = OptimizePose(initial, observations, test::PinholeCamera());
  // Pixels are stored as float, exact to some 1e-5 px.
  EXPECT_THAT(estimate.world_from_camera, test::IsPoseNear(kTruth, 1e-4, 1e-5));
  EXPECT_EQ(estimate.num_inliers, static_cast<int>(observations.size()));
}

TEST(PoseOptimizerTest, DetectsOutliers) {
  test::Random random(2);
  auto observations = Observe(300, 0.5, random);
  for (std::size_t i = 0; i < observations.size(); i += 3) {
    observations.observations[i].pixel +=
        40 * random.Direction().head<2>() + Eigen::Vector2d(30, 0);
  }
  const SE3 initial = kTruth * SE3::Exp(random.Vector<6>(0.05));
  const PoseEstimate estimate = OptimizePose(initial, observations, test::PinholeCamera());
  EXPECT_THAT(estimate.world_from_camera, test::IsPoseNear(kTruth, 0.1, 0.01));
  int num_wrong = 0;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    num_wrong += estimate.is_inlier[i] == (i % 3 == 0);
  }
  EXPECT_LE(num_wrong, static_cast<int>(observations.size() / 50));
}

/// Returns the mean position error over `num_scenes` scenes in which every second point is
/// displaced with a standard deviation of 0.02 along each axis; `is_reported` sets the covariance
/// of these points.
double MeanError(bool is_reported, int num_scenes) {
  constexpr double kPoseSigma = 0.02;
  test::Random random(3);
  double sum = 0;
  for (int i = 0; i < num_scenes; ++i) {
    auto observations = Observe(100, 0.3, random);
    for (std::size_t k = 0; k < observations.size(); k += 2) {
      observations.points[k].in_world += Eigen::Vector3d{
          random.Gaussian(kPoseSigma), random.Gaussian(kPoseSigma), random.Gaussian(kPoseSigma)};
      if (is_reported)
        observations.points[k].covariance = kPoseSigma * kPoseSigma * Eigen::Matrix3d::Identity();
    }
    const PoseEstimate estimate = OptimizePose(kTruth, observations, test::PinholeCamera());
    sum += (estimate.world_from_camera.translation() - kTruth.translation()).norm();
  }
  return sum / num_scenes;
}

TEST(PoseOptimizerTest, UncertainPointsHaveLessWeight) {
  EXPECT_LT(MeanError(true, 20), 0.7 * MeanError(false, 20));
}

TEST(PoseOptimizerTest, AnUncertainPointWithALargeErrorIsAnOutlier) {
  test::Random random(4);
  auto observations = Observe(100, 0.3, random);
  observations.points[0].covariance = Eigen::Matrix3d::Identity();
  observations.observations[0].pixel.x() += 10;
  const PoseEstimate estimate = OptimizePose(kTruth, observations, test::PinholeCamera());
  EXPECT_FALSE(estimate.is_inlier[0]);
  EXPECT_EQ(estimate.num_inliers, static_cast<int>(observations.size()) - 1);
}

TEST(PoseOptimizerTest, ToleratesTooFewOrUselessObservations) {
  const Camera camera = test::PinholeCamera();
  EXPECT_EQ(OptimizePose(kTruth, {}, camera).num_inliers, 0);
  EXPECT_EQ(OptimizePose(kTruth, {}, camera).world_from_camera, kTruth);
  PoseObservations behind;
  for (int i = 0; i < 10; ++i) behind.Add({kTruth * Eigen::Vector3d(0, 0, -5)}, {});
  EXPECT_EQ(OptimizePose(kTruth, behind, camera).num_inliers, 0);
}

TEST(PoseOptimizerTest, SquaredErrorIsInUnitsOfSigma) {
  const Camera camera = test::PinholeCamera();
  // (0, 0, 5) projects to the principal point.
  const Observation observation{0, 0, {319.5 + 6, 239.5 + 8}, 2.0};
  EXPECT_NEAR(SquaredError({0, 0, 5}, observation, camera), 25, 1e-12);
  EXPECT_EQ(SquaredError({0, 0, -5}, observation, camera), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace corvo
