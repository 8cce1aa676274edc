// SPDX-License-Identifier: MIT
#include "vo/camera/centered_pinhole.h"

#include <cmath>

#include <gmock/gmock.h>

#include "vo/camera/camera.h"

namespace corvo {
namespace {

TEST(CenteredPinholeTest, FieldOfViewSpansTheImage) {
  const double focal = FocalOfFov(70, 640);
  EXPECT_NEAR(FovOfFocal(focal, 640), 70, 1e-9);
  const Camera camera(CenteredPinhole(focal, 640, 480));
  const double left = camera.Undistort({-0.5, 0})->x(), right = camera.Undistort({639.5, 0})->x();
  EXPECT_NEAR((std::atan(right) - std::atan(left)) * 180 / M_PI, 70, 1e-9);
  EXPECT_EQ(camera.cx(), 319.5);
  EXPECT_EQ(camera.cy(), 239.5);
}

}  // namespace
}  // namespace corvo
