// SPDX-License-Identifier: MIT
#include "vo/geometry/triangulation.h"

#include <gmock/gmock.h>

#include <numbers>

#include "tests/support/matchers.h"
#include "tests/support/random.h"

namespace corvo {
namespace {

PosedRay RayTo(const Eigen::Vector3d& in_world, const SE3& world_from_camera) {
  return {world_from_camera, (world_from_camera.Inverse() * in_world).hnormalized()};
}

TEST(TriangulationTest, RecoversExactPoints) {
  test::Random random(1);
  for (int i = 0; i < 100; ++i) {
    const SE3 a = random.Pose(0.3, 1), b = random.Pose(0.3, 1);
    const Eigen::Vector3d point(random.Uniform(-2, 2), random.Uniform(-2, 2), 6);
    const auto triangulated = Triangulate(RayTo(point, a), RayTo(point, b));
    ASSERT_TRUE(triangulated);
    EXPECT_THAT(*triangulated, test::IsMatrixNear(point, 1e-8));
  }
}

/// Returns the squared distance of a point's projection from a ray, in normalized image
/// coordinates.
double SquaredMiss(const Eigen::Vector3d& in_world, const PosedRay& ray) {
  return ((ray.world_from_camera.Inverse() * in_world).hnormalized() - ray.ray).squaredNorm();
}

TEST(TriangulationTest, NoisyRaysGiveAMinimumOfTheReprojectionError) {
  test::Random random(2);
  for (int i = 0; i < 100; ++i) {
    PosedRay a, b;
    a.world_from_camera = random.Pose(0.3, 1);
    b.world_from_camera = random.Pose(0.3, 1);
    const Eigen::Vector3d point(random.Uniform(-2, 2), random.Uniform(-2, 2), 6);
    a.ray = RayTo(point, a.world_from_camera).ray + random.Vector<2>(0.002);
    b.ray = RayTo(point, b.world_from_camera).ray + random.Vector<2>(0.002);
    const auto triangulated = Triangulate(a, b);
    ASSERT_TRUE(triangulated);
    const double least = SquaredMiss(*triangulated, a) + SquaredMiss(*triangulated, b);
    for (int j = 0; j < 20; ++j) {
      const Eigen::Vector3d other = *triangulated + random.Vector<3>(0.01);
      EXPECT_GE(SquaredMiss(other, a) + SquaredMiss(other, b), 0.9999 * least) << i;
    }
  }
}

TEST(TriangulationTest, ParallelRaysHaveNoPoint) {
  const SE3 moved(SO3(), Eigen::Vector3d(1, 0, 0));
  EXPECT_FALSE(Triangulate({SE3(), {0.1, 0.2}}, {moved, {0.1, 0.2}}));
}

TEST(TriangulationTest, DivergingRaysMeetBehindTheCameras) {
  const SE3 moved(SO3(), Eigen::Vector3d(1, 0, 0));
  const auto point = Triangulate({SE3(), {-0.1, 0}}, {moved, {0.1, 0}});
  ASSERT_TRUE(point);
  EXPECT_THAT(*point, test::IsMatrixNear(Eigen::Vector3d(0.5, 0, -5), 1e-9));
}

TEST(TriangulationTest, ParallaxMatchesHandComputedAngles) {
  const SE3 left(SO3(), Eigen::Vector3d(-1, 0, 0)), right(SO3(), Eigen::Vector3d(1, 0, 0));
  EXPECT_NEAR(ParallaxAngle({0, 0, 1}, left, right), std::numbers::pi / 2, 1e-12);
  EXPECT_NEAR(ParallaxAngle({0, 0, 1e6}, left, right), 2e-6, 1e-12);
  EXPECT_EQ(ParallaxAngle({0, 0, 1}, left, left), 0);
}

TEST(TriangulationTest, RayAngleIsTheParallaxOfTheIntersection) {
  test::Random random(3);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d point = random.Vector<3>(0.5) + Eigen::Vector3d(0, 0, 5);
    const SE3 a = SE3::Exp(random.Vector<6>(0.3)), b = SE3::Exp(random.Vector<6>(0.3));
    const PosedRay ray_a{a, (a.Inverse() * point).hnormalized()};
    const PosedRay ray_b{b, (b.Inverse() * point).hnormalized()};
    EXPECT_NEAR(RayAngle(ray_a, ray_b), ParallaxAngle(point, a, b), 1e-9);
  }
}

}  // namespace
}  // namespace corvo
