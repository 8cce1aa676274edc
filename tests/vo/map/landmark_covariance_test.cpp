// SPDX-License-Identifier: MIT
#include "vo/map/landmark_covariance.h"

#include <gmock/gmock.h>

#include <vector>

#include "tests/support/matchers.h"
#include "tests/support/point_scene.h"
#include "vo/geometry/triangulation.h"

namespace corvo {
namespace {

constexpr double kSigmaPx = 2;

/// Returns the covariance of a landmark at `point` that cameras at `centers` observe, all of them
/// facing +z.
Eigen::Matrix3d CovarianceAt(const Eigen::Vector3d& point,
                             const std::vector<Eigen::Vector3d>& centers) {
  const Camera camera = test::PinholeCamera();
  test::PointScene scene;
  test::Random random(1);
  scene.in_world = {point};
  scene.descriptors = {test::RandomDescriptor(random)};
  Map map(test::MakeModel(kSigmaPx));
  std::vector<TrackElement> observations;
  for (const Eigen::Vector3d& center : centers) {
    const SE3 pose(SO3(), center);
    observations.push_back(
        {map.AddKeyframe(test::ObserveScene(scene, camera, pose, 0, random).frame, 0), 0});
  }
  const LandmarkId id = map.AddLandmark(point, observations);
  return LandmarkCovariance(map, *map.FindLandmark(id));
}

TEST(LandmarkCovarianceTest, AnObservationConstrainsThePointAcrossItsRay) {
  // The standard deviation is σ d / f = 2 * 5 / 500 across the ray and 10 d = 50 along it. Two
  // observations along one ray halve both variances.
  const Eigen::Matrix3d covariance = CovarianceAt({0, 0, 5}, {{0, 0, 0}, {0, 0, 0}});
  EXPECT_THAT(
      covariance,
      test::IsMatrixNear(Eigen::Vector3d(2e-4, 2e-4, 1250).asDiagonal().toDenseMatrix(), 1e-6));
}

TEST(LandmarkCovarianceTest, MatchesTheScatterOfTriangulatedPoints) {
  const Eigen::Vector3d point(0.2, -0.1, 6);
  const SE3 left, right(SO3(), {0.5, 0, 0.2});
  const Camera camera = test::PinholeCamera();
  test::Random random(2);
  const auto noisy_ray = [&](const SE3& pose) {
    const Eigen::Vector2d noise{random.Gaussian(kSigmaPx), random.Gaussian(kSigmaPx)};
    return PosedRay{pose, *camera.Undistort(*camera.Project(pose.Inverse() * point) + noise)};
  };
  constexpr int kDraws = 4000;
  Eigen::Matrix3d scatter = Eigen::Matrix3d::Zero();
  for (int i = 0; i < kDraws; ++i) {
    const PosedRay ray = noisy_ray(left);
    const Eigen::Vector3d error = *Triangulate(ray, noisy_ray(right)) - point;
    scatter += error * error.transpose() / kDraws;
  }
  const Eigen::Matrix3d covariance = CovarianceAt(point, {left.translation(), right.translation()});
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(scatter(axis, axis) / covariance(axis, axis), 1, 0.15) << axis;
  }
}

}  // namespace
}  // namespace corvo
