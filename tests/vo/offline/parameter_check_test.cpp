// SPDX-License-Identifier: MIT
#include "vo/offline/parameter_check.h"

#include <cmath>
#include <functional>
#include <vector>

#include <gmock/gmock.h>

#include "tests/support/point_scene.h"

namespace corvo {
namespace {

/// Returns a map of a turning walk with the true camera, which then gets another one.
Map MakeMapWith(const std::function<void(CameraParameters&)>& change) {
  test::Random random(1);
  const test::PointScene scene = test::MakeBoxScene(900, 3, 12, random);
  std::vector<test::SceneView> views;
  for (int i = 0; i < 24; ++i) {
    const Eigen::Vector3d turn(0.3 * std::sin(0.7 * i), 0.35 * std::sin(0.4 * i),
                               0.5 * std::sin(0.9 * i));
    const Eigen::Vector3d position(0.15 * i, 0.3 * std::sin(0.5 * i), 0.4 * std::sin(0.3 * i));
    views.push_back(test::ObserveScene(scene, test::PinholeCamera(), SE3(SO3::Exp(turn), position),
                                       0.3, random));
  }
  Map map = test::MakeMap(scene, views);
  CameraParameters camera = map.camera().parameters();
  change(camera);
  map.SetCamera(Camera(camera));
  return map;
}

TEST(FindMisfittingParameters, ATrueCameraHasNone) {
  EXPECT_TRUE(FindMisfittingParameters(MakeMapWith([](CameraParameters&) {})).empty());
}

TEST(FindMisfittingParameters, NamesThePrincipalPoint) {
  const double cy = test::PinholeCamera().parameters().cy;
  const auto misfitting =
      FindMisfittingParameters(MakeMapWith([](CameraParameters& camera) { camera.cy += 6; }));
  ASSERT_FALSE(misfitting.empty());
  EXPECT_EQ(misfitting.front().name, "cy");
  EXPECT_DOUBLE_EQ(misfitting.front().used, cy + 6);
  EXPECT_NEAR(misfitting.front().fitted, cy, 4 * misfitting.front().sigma);
}

TEST(FindMisfittingParameters, NamesTheTangentialDistortion) {
  const auto misfitting =
      FindMisfittingParameters(MakeMapWith([](CameraParameters& camera) { camera.p1 = 0.006; }));
  ASSERT_FALSE(misfitting.empty());
  EXPECT_EQ(misfitting.front().name, "p1");
  EXPECT_NEAR(misfitting.front().fitted, 0, 4 * misfitting.front().sigma);
}

TEST(FindMisfittingParameters, AMapOfFewKeyframesIsNotJudged) {
  EXPECT_TRUE(FindMisfittingParameters(Map(test::MakeModel())).empty());
}

}  // namespace
}  // namespace corvo
