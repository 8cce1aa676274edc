// SPDX-License-Identifier: MIT
#include "apps/run/kitti_trajectory.h"

#include <gtest/gtest.h>

namespace corvo {
namespace {

FrameResult Posed(int segment, double x) {
  FrameResult frame;
  frame.segment = segment;
  frame.world_from_camera = SE3(SO3(), Eigen::Vector3d(x, 0, 0));
  return frame;
}

TEST(KittiTrajectory, HasARowForEveryFrame) {
  const Trajectory trajectory{{Posed(0, 1), Posed(0, 2)}};
  EXPECT_EQ(WhyNotKitti(trajectory), "");
  const std::vector<SE3> rows = KittiRows(trajectory);
  ASSERT_EQ(rows.size(), 2);
  EXPECT_EQ(rows[1].translation().x(), 2);
}

TEST(KittiTrajectory, ExplainsWhyATrajectoryCannotBeWritten) {
  EXPECT_EQ(WhyNotKitti({{Posed(0, 1), FrameResult(), Posed(0, 2)}}), "1 of 3 frames have no pose");
  EXPECT_EQ(WhyNotKitti({{Posed(0, 1), Posed(1, 2)}}), "the poses are in 2 segments");
}

}  // namespace
}  // namespace corvo
