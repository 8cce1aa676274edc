// SPDX-License-Identifier: MIT
#include "apps/synthetic/motion.h"

#include <cmath>

#include <gmock/gmock.h>

#include "tests/support/matchers.h"

namespace corvo::synthetic {
namespace {

using Eigen::Vector3d;
using test::IsMatrixNear;

/// The scene has z up; the camera has x right, y down and z forward.
TEST(SceneFromCamera, DefaultViewpointLooksAlongX) {
  const SE3 scene_from_camera = SceneFromCamera({});
  EXPECT_THAT(scene_from_camera * Vector3d(0, 0, 1), IsMatrixNear(Vector3d(1, 0, 0), 1e-12));
  EXPECT_THAT(scene_from_camera * Vector3d(1, 0, 0), IsMatrixNear(Vector3d(0, -1, 0), 1e-12));
  EXPECT_THAT(scene_from_camera * Vector3d(0, 1, 0), IsMatrixNear(Vector3d(0, 0, -1), 1e-12));
}

TEST(SceneFromCamera, YawTurnsLeftAndPitchTurnsUp) {
  Viewpoint viewpoint;
  viewpoint.yaw = 0.3;
  EXPECT_THAT(SceneFromCamera(viewpoint) * Vector3d(0, 0, 1),
              IsMatrixNear(Vector3d(std::cos(0.3), std::sin(0.3), 0), 1e-12));
  viewpoint = {};
  viewpoint.pitch = 0.2;
  EXPECT_THAT(SceneFromCamera(viewpoint) * Vector3d(0, 0, 1),
              IsMatrixNear(Vector3d(std::cos(0.2), 0, std::sin(0.2)), 1e-12));
}

TEST(SceneFromCamera, RollKeepsTheAxisAndLowersTheRightSide) {
  Viewpoint viewpoint{Vector3d(1, 2, 3), 0.4, -0.1, 0};
  const SE3 level = SceneFromCamera(viewpoint);
  viewpoint.roll = 0.5;
  const SE3 rolled = SceneFromCamera(viewpoint);
  EXPECT_THAT(rolled * Vector3d(0, 0, 1), IsMatrixNear(level * Vector3d(0, 0, 1), 1e-12));
  EXPECT_LT((rolled * Vector3d(1, 0, 0)).z(), (level * Vector3d(1, 0, 0)).z());
}

CameraParameters VgaCamera() {
  CameraParameters camera;
  camera.width = 640;
  camera.height = 480;
  camera.fx = camera.fy = 500;
  camera.cx = 319.5;
  camera.cy = 239.5;
  return camera;
}

TEST(ChooseCamera, ScalesTheCameraTreatingPixelsAsAreas) {
  SequenceOptions options;
  options.width = 320;
  const Camera half = ChooseCamera(VgaCamera(), options);
  EXPECT_EQ(half.height(), 240);
  EXPECT_DOUBLE_EQ(half.fx(), 250);
  EXPECT_DOUBLE_EQ(half.cx(), 159.5);
  EXPECT_DOUBLE_EQ(half.cy(), 119.5);
}

TEST(ChooseCamera, PrefersTheCameraOfTheOptions) {
  SequenceOptions options;
  options.width = 320;
  options.camera = VgaCamera();
  options.camera->k1 = -0.2;
  EXPECT_EQ(ChooseCamera(VgaCamera(), options).parameters(), *options.camera);
}

}  // namespace
}  // namespace corvo::synthetic
