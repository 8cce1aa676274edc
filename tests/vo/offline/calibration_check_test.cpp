// SPDX-License-Identifier: MIT
#include "vo/offline/calibration_check.h"

#include <cmath>
#include <vector>

#include <gmock/gmock.h>

#include "tests/support/point_scene.h"

namespace corvo {
namespace {

/// Returns the true poses of a camera that walks on a curve and turns.
std::vector<SE3> Walk(int num_frames) {
  std::vector<SE3> poses;
  for (int i = 0; i < num_frames; ++i) {
    const Eigen::Vector3d turn(0.1 * std::sin(0.7 * i), 0.25 * std::sin(0.4 * i), 0);
    const Eigen::Vector3d position(0.15 * i, 0.3 * std::sin(0.5 * i), 0.4 * std::sin(0.3 * i));
    poses.emplace_back(SO3::Exp(turn), position);
  }
  return poses;
}

/// Returns a map of a walk with the true camera, or one whose keyframes were adjusted to a camera
/// with a focal length that is wrong by a factor.
Map MakeWalkMap(double focal_factor, bool is_straight = false) {
  test::Random random(1);
  const test::PointScene scene = test::MakeBoxScene(900, 3, 12, random);
  std::vector<test::SceneView> views;
  for (SE3 pose : Walk(24)) {
    if (is_straight) pose = SE3(SO3(), {0, 0, 0.1 * pose.translation().x()});
    views.push_back(test::ObserveScene(scene, test::PinholeCamera(), pose, 0.8, random));
  }
  Map map = test::MakeMap(scene, views);
  CameraParameters camera = map.camera().parameters();
  camera.fx *= focal_factor;
  camera.fy *= focal_factor;
  map.SetCamera(Camera(camera));
  return map;
}

TEST(CalibrationCheckTest, ACorrectCameraIsPlausible) {
  const CalibrationCheck check = CheckCalibration(MakeWalkMap(1));
  EXPECT_EQ(check.num_parts, 4);
  EXPECT_EQ(check.num_agreeing, 0);
  EXPECT_NEAR(check.focal_px, 500, 5);
  EXPECT_FALSE(check.is_implausible);
}

TEST(CalibrationCheckTest, AFocalLengthThatIsOffByATenthIsImplausible) {
  for (const double factor : {0.9, 1.1}) {
    const CalibrationCheck check = CheckCalibration(MakeWalkMap(factor));
    EXPECT_GE(check.num_agreeing, 3) << factor;
    EXPECT_NEAR(check.focal_px, 500, 15) << factor;
    EXPECT_TRUE(check.is_implausible) << factor;
  }
}

TEST(CalibrationCheckTest, TwoPartsThatAgreeAreEnough) {
  CalibrationCheckOptions options;
  options.num_parts = 2;
  const CalibrationCheck check = CheckCalibration(MakeWalkMap(1.1), options);
  EXPECT_EQ(check.num_agreeing, 2);
  EXPECT_TRUE(check.is_implausible);
}

TEST(CalibrationCheckTest, LessThanHalfOfThePartsAreNotEnough) {
  constexpr double kFocals[] = {410, 450, 450, 500, 550};
  test::Random random(1);
  const test::PointScene scene = test::MakeBoxScene(900, 3, 12, random);
  const std::vector<SE3> poses = Walk(30);
  std::vector<test::SceneView> views;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    CameraParameters camera = test::PinholeCamera().parameters();
    camera.fx = camera.fy = kFocals[i / 6];
    views.push_back(test::ObserveScene(scene, Camera(camera), poses[i], 0.1, random));
  }
  CalibrationCheckOptions options;
  options.num_parts = 5;
  const CalibrationCheck check = CheckCalibration(test::MakeMap(scene, views), options);
  EXPECT_EQ(check.num_parts, 5);
  EXPECT_EQ(check.num_agreeing, 2);
  EXPECT_NEAR(check.focal_px, 450, 5);
  EXPECT_FALSE(check.is_implausible);
}

TEST(CalibrationCheckTest, PartsThatDisagreeDoNotMakeTheCalibrationImplausible) {
  Map map = MakeWalkMap(1.1);
  // Wrong matches: in half of the parts the landmarks of a keyframe are shifted in depth.
  CameraParameters shorter = map.camera().parameters();
  shorter.fx = shorter.fy = 500;
  map.SetCamera(Camera(shorter));
  test::Random random(2);
  for (const LandmarkId id : map.FindObserved({0, 1, 2, 3, 4, 5})) {
    const Eigen::Vector3d in_world = map.FindLandmark(id)->in_world;
    map.SetPosition(id, in_world * (1 + random.Gaussian(0.1)));
  }
  EXPECT_FALSE(CheckCalibration(map).is_implausible);
}

TEST(CalibrationCheckTest, AMotionThatDoesNotDetermineTheFocalLengthContradictsNothing) {
  EXPECT_FALSE(CheckCalibration(MakeWalkMap(1.1, true)).is_implausible);
}

TEST(CalibrationCheckTest, AContradictedFocalLengthIsAsUncertainAsItsContradiction) {
  const CameraPrior prior{{}, {{"focal", 0.002}, {"k1", 0.03}}};
  const Eigen::Vector2d variances(4e-6, 9e-4);
  PoseGraph graph;
  graph.camera_covariance = variances.asDiagonal();
  CalibrationCheck check{4, 4, 550, false};
  WidenFocalLength(check, prior, 500, graph);
  EXPECT_EQ(graph.camera_covariance.diagonal(), variances);
  check.is_implausible = true;
  WidenFocalLength(check, prior, 500, graph);
  EXPECT_NEAR(graph.camera_covariance(0, 0), std::pow(std::log(1.1), 2), 1e-12);
  EXPECT_EQ(graph.camera_covariance(1, 1), 9e-4);
}

TEST(CalibrationCheckTest, AMapOfFewKeyframesIsNotJudged) {
  const CalibrationCheck check = CheckCalibration(Map(test::MakeModel()));
  EXPECT_EQ(check.num_parts, 0);
  EXPECT_FALSE(check.is_implausible);
}

}  // namespace
}  // namespace corvo
