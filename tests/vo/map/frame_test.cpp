// SPDX-License-Identifier: MIT
#include "vo/map/frame.h"

#include <gmock/gmock.h>

#include "tests/support/matchers.h"
#include "tests/support/point_scene.h"

namespace corvo {
namespace {

orb::Keypoint KeypointAt(float x, float y) {
  orb::Keypoint keypoint;
  keypoint.x = x;
  keypoint.y = y;
  return keypoint;
}

TEST(FrameTest, KeypointsKeepTheirPixelAndGetARay) {
  orb::Features features;
  features.keypoints = {KeypointAt(419.5, 139.5)};
  features.descriptors.resize(1);
  const Frame frame = MakeFrame(3, 42, features, test::PinholeCamera());
  EXPECT_EQ(frame.index, 3);
  EXPECT_EQ(frame.time_ns, 42);
  EXPECT_EQ(frame.pixel(0), Eigen::Vector2d(419.5, 139.5));
  EXPECT_THAT(frame.rays[0], test::IsMatrixNear(Eigen::Vector2d(0.2, -0.2), 1e-12));
  EXPECT_THAT(frame.landmarks, ::testing::ElementsAre(kNoId));
}

TEST(FrameTest, KeypointsWithoutARayAreDropped) {
  CameraParameters parameters = test::PinholeCamera().parameters();
  parameters.k1 = -0.8;  // The distortion turns over inside the image corners.
  orb::Features features;
  features.keypoints = {KeypointAt(0, 0), KeypointAt(320, 240)};
  features.descriptors.resize(2);
  features.descriptors[1].bytes[0] = 7;
  const Frame frame = MakeFrame(0, 0, features, Camera(parameters));
  ASSERT_EQ(frame.num_keypoints(), 1);
  EXPECT_EQ(frame.keypoint(0).x, 320);
  EXPECT_EQ(frame.descriptor(0).bytes[0], 7);
  EXPECT_EQ(frame.rays.size(), 1u);
}

TEST(FrameTest, UpdateRaysUsesTheNewCamera) {
  orb::Features features;
  features.keypoints = {KeypointAt(0, 0), KeypointAt(419.5, 139.5)};
  features.descriptors.resize(2);
  Frame frame = MakeFrame(0, 0, features, test::PinholeCamera());
  const Eigen::Vector2d old_corner_ray = frame.rays[0];
  CameraParameters parameters = test::PinholeCamera().parameters();
  parameters.k1 = -0.8;  // The distortion turns over inside the image corners.
  const Camera camera(parameters);
  UpdateRays(camera, frame);
  EXPECT_EQ(frame.camera, parameters);
  EXPECT_EQ(frame.rays[0], old_corner_ray);
  EXPECT_EQ(frame.rays[1], *camera.Undistort({419.5, 139.5}));
}

TEST(MeasurementModelTest, SigmaGrowsWithTheOctaveAndShrinksWithAlignment) {
  MeasurementModel model = test::MakeModel(0.5);
  model.options.aligned_sigma_px = 0.25;
  orb::Features features;
  features.keypoints.resize(2);
  features.descriptors.resize(2);
  features.keypoints[1].octave = 2;
  Frame frame = MakeFrame(0, 0, features, test::PinholeCamera());
  EXPECT_DOUBLE_EQ(model.Sigma(frame, 0), 0.5);
  EXPECT_DOUBLE_EQ(model.Sigma(frame, 1), 0.72);
  frame.is_aligned[1] = 1;
  EXPECT_DOUBLE_EQ(model.Sigma(frame, 1), 0.36);
}

}  // namespace
}  // namespace corvo
