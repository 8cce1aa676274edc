// SPDX-License-Identifier: MIT
#include "vo/camera/camera_fit.h"

#include <gmock/gmock.h>

#include <algorithm>

#include <Eigen/Geometry>

#include "tests/support/point_scene.h"

namespace corvo {
namespace {

/// Returns the greatest distance, in pixels, between the projections of the same ray by two
/// cameras, over the image of the first.
double GreatestDistance(const Camera& first, const Camera& second) {
  double greatest = 0;
  for (int x = 0; x < first.width(); x += 20) {
    for (int y = 0; y < first.height(); y += 20) {
      const Eigen::Vector3d ray = first.Undistort({x, y}).value().homogeneous();
      greatest = std::max(greatest, (second.Project(ray).value() - Eigen::Vector2d(x, y)).norm());
    }
  }
  return greatest;
}

Camera DistortedCamera(double k1) {
  CameraParameters parameters = test::PinholeCamera().parameters();
  parameters.k1 = k1;
  return Camera(parameters);
}

TEST(CameraFitTest, FittingTheSameModelReturnsTheSameCamera) {
  const Camera camera = DistortedCamera(-0.1);
  EXPECT_EQ(FitCamera(camera, CameraModel::kPinhole), camera.parameters());
}

TEST(CameraFitTest, AFisheyeModelReproducesAPinholeCamera) {
  for (const double k1 : {-0.2, 0.0, 0.1}) {
    const Camera camera = DistortedCamera(k1);
    EXPECT_LT(GreatestDistance(camera, Camera(FitCamera(camera, CameraModel::kKb4))), 0.1) << k1;
  }
}

TEST(CameraFitTest, FittingBackRecoversTheOriginalLens) {
  CameraParameters lens = test::PinholeCamera().parameters();
  lens.model = CameraModel::kFov;
  lens.omega = 0.8;
  const Camera as_pinhole(FitCamera(Camera(lens), CameraModel::kPinhole));
  EXPECT_LT(GreatestDistance(Camera(lens), as_pinhole), 1);
  const CameraParameters again = FitCamera(as_pinhole, CameraModel::kFov);
  EXPECT_NEAR(again.omega, lens.omega, 0.02);
  EXPECT_NEAR(again.fx, lens.fx, 0.005 * lens.fx);
}

}  // namespace
}  // namespace corvo
