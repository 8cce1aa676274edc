// SPDX-License-Identifier: MIT
#include "vo/map/landmark_projection.h"

#include <gmock/gmock.h>

#include "tests/support/matchers.h"
#include "tests/support/point_scene.h"

namespace corvo {
namespace {

/// Makes a landmark at (0, 0, 10) that was observed from the origin in octave 2.
Landmark MakeLandmark() {
  Landmark landmark;
  landmark.in_world = {0, 0, 10};
  landmark.view_direction = {0, 0, 1};
  landmark.max_distance = 10 * 1.44;
  return landmark;
}

std::optional<LandmarkView> ViewFrom(const SE3& world_from_camera) {
  return ProjectLandmark(MakeLandmark(), world_from_camera, test::MakeModel(1, 5));
}

SE3 PositionedAt(double x, double y, double z) { return SE3(SO3(), Eigen::Vector3d(x, y, z)); }

TEST(LandmarkProjectionTest, PredictsPixelAngleAndOctave) {
  const auto view = ViewFrom(PositionedAt(0, 0, 1e-9));
  ASSERT_TRUE(view);
  EXPECT_THAT(view->pixel, test::IsMatrixNear(Eigen::Vector2d(319.5, 239.5), 1e-9));
  EXPECT_NEAR(view->view_cosine, 1, 1e-12);
  EXPECT_THAT(view->octave, ::testing::AnyOf(2, 3));
  EXPECT_EQ(ViewFrom(PositionedAt(0, 0, 10 - 14))->octave, 1);  // Farther: finer octave.
  EXPECT_EQ(ViewFrom(PositionedAt(0, 0, 10 - 8))->octave, 4);   // Nearer: coarser octave.
  EXPECT_EQ(ViewFrom(PositionedAt(0, 0, 10 - 7))->octave, 4);   // The coarsest octave.
}

TEST(LandmarkProjectionTest, LandmarksOutOfViewHaveNoProjection) {
  EXPECT_FALSE(ViewFrom(PositionedAt(0, 0, 11)));   // Behind the camera.
  EXPECT_FALSE(ViewFrom(PositionedAt(0, 0, -20)));  // Too far for octave 0.
  EXPECT_FALSE(ViewFrom(PositionedAt(0, 0, 8)));    // Too near for the last octave.
  EXPECT_FALSE(ViewFrom(SE3(SO3::Exp({0, 1, 0}), Eigen::Vector3d::Zero())));  // Outside the image.
  const SE3 beside(SO3::Exp({0, -1.2, 0}), Eigen::Vector3d(9.5, 0, 6.5));
  EXPECT_FALSE(ViewFrom(beside));  // More than 60 degrees off its view direction.
}

TEST(LandmarkProjectionTest, SearchWindowSpansTheGivenOctaves) {
  LandmarkView view;
  view.pixel = {10, 20};
  view.octave = 3;
  const orb::SearchWindow window = view.Window(5, 1, 2);
  EXPECT_EQ(window.x, 10);
  EXPECT_EQ(window.y, 20);
  EXPECT_EQ(window.radius, 5);
  EXPECT_EQ(window.min_octave, 2);
  EXPECT_EQ(window.max_octave, 5);
}

}  // namespace
}  // namespace corvo
