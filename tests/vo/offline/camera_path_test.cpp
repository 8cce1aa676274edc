// SPDX-License-Identifier: MIT
#include "vo/offline/camera_path.h"

#include <gtest/gtest.h>

namespace corvo {
namespace {

/// Appends a posed frame of a segment at a position, with the camera turned about its y axis.
void AddFrame(const Eigen::Vector3d& position, double yaw, int segment, Trajectory& trajectory) {
  FrameResult frame;
  frame.index = static_cast<int>(trajectory.frames.size());
  frame.segment = segment;
  frame.world_from_camera = SE3(SO3::Exp({0, yaw, 0}), position);
  trajectory.frames.push_back(frame);
}

/// Returns a drive straight ahead with steps of 1.
Trajectory StraightDrive(int num_frames) {
  Trajectory trajectory;
  for (int i = 0; i < num_frames; ++i) AddFrame({0, 0, 1.0 * i}, 0, 0, trajectory);
  return trajectory;
}

TEST(CameraPathTest, PlacesAreFramesBetweenWhichTheCameraMoved) {
  Trajectory trajectory = StraightDrive(3);
  AddFrame({0, 0, 2}, 0.1, 0, trajectory);     // Turns on the spot,
  AddFrame({0, 0, 2.01}, 0.2, 0, trajectory);  // hardly moves,
  AddFrame({0, 0, 3}, 0.2, 0, trajectory);     // and drives on.
  AddFrame({9, 9, 9}, 0, 1, trajectory);       // Another segment.
  const CameraPath path(trajectory, 0);
  ASSERT_EQ(path.places().size(), 4);
  EXPECT_EQ(path.places()[3].frame, 5);
  EXPECT_DOUBLE_EQ(path.places()[3].distance, 3);
}

TEST(CameraPathTest, ASegmentWithoutPosesHasNoPlacesAndOneWithoutMotionHasOne) {
  Trajectory trajectory;
  AddFrame({1, 2, 3}, 0, 0, trajectory);
  AddFrame({1, 2, 3}, 0, 0, trajectory);
  EXPECT_EQ(CameraPath(trajectory, 0).places().size(), 1);
  EXPECT_TRUE(CameraPath(trajectory, 1).places().empty());
}

TEST(CameraPathTest, APointIsSeenFromTheNearestPlace) {
  const CameraPath path(StraightDrive(200), 0);
  const PassedPoint passed = path.Pass({2, 1.5, 150.25});
  EXPECT_EQ(passed.place, 150);
  EXPECT_DOUBLE_EQ(passed.right, 2);
  EXPECT_DOUBLE_EQ(passed.below, 1.5);
  EXPECT_DOUBLE_EQ(passed.beyond, 0.25);
}

TEST(CameraPathTest, TheNearestPlaceIsThatOfAFullSearch) {
  Trajectory trajectory;
  for (int i = 0; i < 500; ++i) {
    const double angle = 0.05 * i;
    AddFrame({(10 + 0.02 * i) * std::cos(angle), 0, (10 + 0.02 * i) * std::sin(angle)}, 0, 0,
             trajectory);
  }
  const CameraPath path(trajectory, 0);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d point(30 * std::sin(1.0 * i), std::cos(3.0 * i), 30 * std::cos(7.0 * i));
    const auto distance = [&](int place) {
      return (path.places()[place].world_from_camera.translation() - point).norm();
    };
    const double nearest = distance(path.Nearest(point));
    for (int k = 0; k < static_cast<int>(path.places().size()); ++k) {
      EXPECT_LE(nearest, distance(k));
    }
  }
}

TEST(CameraPathTest, APitchOfTheCameraDoesNotChangeWhatIsBelow) {
  Trajectory trajectory = StraightDrive(10);
  for (FrameResult& frame : trajectory.frames) {
    const Eigen::Vector3d position = frame.world_from_camera->translation();
    frame.world_from_camera = SE3(SO3::Exp({-0.3, 0, 0}), position);
  }
  EXPECT_NEAR(CameraPath(trajectory, 0).Pass({0, 1.5, 5}).below, 1.5, 1e-12);
}

}  // namespace
}  // namespace corvo
