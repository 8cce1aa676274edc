// SPDX-License-Identifier: MIT
#include "vo/offline/match_residuals.h"

#include <cmath>
#include <vector>

#include <gmock/gmock.h>

#include "tests/support/point_scene.h"

namespace corvo {
namespace {

/// Maps with true poses and positions, observed by a camera that moves sideways.
class ResidualsTest : public ::testing::Test {
 protected:
  Map MakeMap(double sigma_px) {
    test::Random random(1);
    const test::PointScene scene = test::MakeBoxScene(400, 4, 12, random);
    std::vector<test::SceneView> views;
    for (int i = 0; i < 4; ++i) {
      const SE3 world_from_camera(SO3(), Eigen::Vector3d(0.3 * i, 0, 0));
      views.push_back(
          test::ObserveScene(scene, test::PinholeCamera(), world_from_camera, sigma_px, random));
    }
    return test::MakeMap(scene, views);
  }
};

TEST_F(ResidualsTest, MedianResidualIsThatOfThePixelNoise) {
  const auto residuals = MeasureResiduals(MakeMap(0.8));
  ASSERT_TRUE(residuals);
  EXPECT_GT(residuals->num_matches, 500);
  EXPECT_NEAR(residuals->median_px, 0.8 * 1.177, 0.08);  // Rayleigh median: sigma sqrt(2 ln 2).
  EXPECT_FALSE(IsImplausible(*residuals));
}

TEST_F(ResidualsTest, ResidualsOfAWrongCameraAreImplausible) {
  CameraParameters other = test::PinholeCamera().parameters();
  other.fx *= 1.05;
  other.fy *= 1.05;
  Map map = MakeMap(0.8);
  map.SetCamera(Camera(other));
  const auto residuals = MeasureResiduals(map);
  ASSERT_TRUE(residuals);
  EXPECT_GT(residuals->median_px, 4);
  EXPECT_TRUE(IsImplausible(*residuals));
}

TEST_F(ResidualsTest, AnEmptyMapHasNoResiduals) {
  EXPECT_FALSE(MeasureResiduals(Map(test::MakeModel())));
}

TEST_F(ResidualsTest, PartsWithoutMatchesAreNotJudged) {
  test::Random random(1);
  const test::PointScene scene = test::MakeBoxScene(400, 4, 12, random);
  std::vector<test::SceneView> views;
  for (int i = 0; i < 4; ++i) {
    // The camera of the last keyframe looks away from the scene.
    const SO3 turn = SO3::Exp(Eigen::Vector3d(0, i < 3 ? 0 : 3, 0));
    const SE3 world_from_camera(turn, Eigen::Vector3d(0.3 * i, 0, 0));
    views.push_back(
        test::ObserveScene(scene, test::PinholeCamera(), world_from_camera, 0.8, random));
  }
  const auto residuals = MeasureResiduals(test::MakeMap(scene, views));
  ASSERT_TRUE(residuals);
  EXPECT_GT(residuals->least_part_px, 0.7);
}

TEST_F(ResidualsTest, FewMatchesAreNeverImplausible) {
  EXPECT_FALSE(IsImplausible({99, 5, 5}));
  EXPECT_TRUE(IsImplausible({100, 2.1, 2.1}));
  EXPECT_FALSE(IsImplausible({100, 2, 2}));
}

TEST_F(ResidualsTest, LargeResidualsInOnePartAreNotImplausible) {
  EXPECT_FALSE(IsImplausible({1000, 8, 0.7}));
  Map map = MakeMap(0.8);
  // A keyframe in the wrong place, as after a blurred turn.
  const SE3 world_from_camera = map.WorldFromKeyframe(3);
  map.SetPose(3, world_from_camera * SE3(SO3::Exp(Eigen::Vector3d(0, 0.03, 0)), {0, 0, 0}));
  const auto residuals = MeasureResiduals(map);
  ASSERT_TRUE(residuals);
  EXPECT_LT(residuals->least_part_px, 1.2);
  EXPECT_FALSE(IsImplausible(*residuals));
}

/// Returns a map in which every second landmark has the descriptor of another one at a random place
/// in its search window.
Map MakeMapWithChanceMatches() {
  test::Random random(1);
  test::PointScene scene = test::MakeBoxScene(400, 4, 12, random);
  std::vector<test::SceneView> views;
  for (int i = 0; i < 4; ++i) {
    const SE3 world_from_camera(SO3(), Eigen::Vector3d(0.3 * i, 0, 0));
    views.push_back(
        test::ObserveScene(scene, test::PinholeCamera(), world_from_camera, 0.8, random));
  }
  Map map = test::MakeMap(scene, views);
  for (const LandmarkId id : map.FindObserved(map.ActiveKeyframes())) {
    if (id % 5 >= 3) continue;
    const Eigen::Vector3d in_world = map.FindLandmark(id)->in_world;
    const double radius = 0.11 * in_world.z() * std::sqrt(random.Uniform(0, 1));  // 55 px.
    const double angle = random.Uniform(0, 6.283);
    map.SetPosition(id, in_world + radius * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0));
  }
  return map;
}

TEST_F(ResidualsTest, MatchesByChanceDoNotCountInTheMedian) {
  const auto residuals = MeasureResiduals(MakeMapWithChanceMatches());
  ASSERT_TRUE(residuals);
  EXPECT_GT(residuals->num_matches, 500);
  EXPECT_LT(residuals->median_px, 2);
  EXPECT_FALSE(IsImplausible(*residuals));
}

}  // namespace
}  // namespace corvo
