// SPDX-License-Identifier: MIT
#include "vo/camera/camera_displacement.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/support/point_scene.h"

namespace corvo {
namespace {

TEST(CameraDisplacementTest, IsZeroForTheSameCamera) {
  EXPECT_NEAR(LargestDisplacement(test::PinholeCamera(), test::PinholeCamera()), 0, 1e-9);
}

TEST(CameraDisplacementTest, IsThatOfThePrincipalPoint) {
  CameraParameters moved = test::PinholeCamera().parameters();
  moved.cx += 3;
  moved.cy -= 4;
  EXPECT_NEAR(LargestDisplacement(test::PinholeCamera(), Camera(moved)), 5, 1e-9);
}

TEST(CameraDisplacementTest, OfAnotherFocalLengthIsLargestInTheFarthestCorner) {
  CameraParameters camera = test::PinholeCamera().parameters();
  camera.width = 401;
  camera.height = 301;
  camera.cx = 100;
  camera.cy = 0;
  CameraParameters longer = camera;
  longer.fx *= 1.01;
  longer.fy *= 1.01;
  EXPECT_NEAR(LargestDisplacement(Camera(camera), Camera(longer)), 0.01 * std::hypot(300, 300),
              1e-9);
}

TEST(CameraDisplacementTest, PixelsWithoutARayDoNotCount) {
  CameraParameters bent = test::PinholeCamera().parameters();
  bent.k1 = -0.9;  // The largest distorted radius is 0.406.
  bent.fx = bent.fy = 0.5 * bent.width;
  CameraParameters moved = bent;
  moved.cx += 1;
  EXPECT_NEAR(LargestDisplacement(Camera(bent), Camera(moved)), 1, 1e-9);
}

}  // namespace
}  // namespace corvo
