// SPDX-License-Identifier: MIT
#include "vo/core/trajectory.h"

#include <gmock/gmock.h>

#include <set>
#include <string>

namespace corvo {
namespace {

FrameResult MakeFrame(TimeNs time_ns, bool posed) {
  FrameResult frame;
  frame.time_ns = time_ns;
  if (posed) frame.world_from_camera = SE3(SO3(), Eigen::Vector3d(1e-9 * time_ns, 0, 0));
  return frame;
}

TEST(TrajectoryTest, PosedFramesLeavesOutFramesWithoutAPose) {
  const Trajectory trajectory{
      {MakeFrame(10, false), MakeFrame(20, true), MakeFrame(30, false), MakeFrame(40, true)}};
  const PoseSequence poses = trajectory.PosedFrames();
  ASSERT_EQ(poses.size(), 2);
  EXPECT_EQ(poses[0].time_ns, 20);
  EXPECT_EQ(poses[1].time_ns, 40);
  EXPECT_EQ(poses[1].world_from_camera, *trajectory.frames[3].world_from_camera);
  EXPECT_EQ(trajectory.PosedShare(), 0.5);
}

TEST(TrajectoryTest, EmptyTrajectoryHasNoPosedFrames) {
  EXPECT_TRUE(Trajectory().PosedFrames().empty());
  EXPECT_EQ(Trajectory().PosedShare(), 0);
}

FrameResult MakeFrame(int index, int segment, bool posed) {
  FrameResult frame = MakeFrame(10 * index, posed);
  frame.index = index;
  frame.segment = segment;
  return frame;
}

TEST(TrajectoryTest, SegmentsAreThoseOfPosedFramesWithTheirScales) {
  Trajectory trajectory;
  trajectory.frames = {MakeFrame(0, 0, false), MakeFrame(1, 0, true),  MakeFrame(2, 0, true),
                       MakeFrame(3, 0, false), MakeFrame(4, 1, false), MakeFrame(5, 2, true)};
  const SegmentScale guessed{ScaleSource::kMedianSpeed, 1.5};
  trajectory.scales = {{}, {}, guessed};
  EXPECT_THAT(trajectory.Segments(),
              testing::ElementsAre(Segment{0, 1, 2, 2, {}}, Segment{2, 5, 5, 1, guessed}));
  trajectory.scales.clear();
  EXPECT_EQ(trajectory.Segments().back().scale, SegmentScale());
}

TEST(SegmentTest, SourcesOfTheScaleHaveNames) {
  EXPECT_EQ(ToString(ScaleSource::kArbitrary), "arbitrary");
  EXPECT_EQ(ToString(ScaleSource::kMedianSpeed), "median_speed");
  EXPECT_EQ(ToString(ScaleSource::kCameraHeight), "camera_height");
  EXPECT_EQ(ToString(ScaleSource::kKnownDistance), "known_distance");
  EXPECT_EQ(ToString(ScaleSource::kKnownSize), "known_size");
}

TEST(FrameResultTest, StatesAndReasonsHaveUniqueNames) {
  EXPECT_EQ(ToString(State::kTracking), "tracking");
  EXPECT_EQ(ToString(Reason::kLowParallax), "low_parallax");
  std::set<std::string_view> names;
  for (int i = 0; i <= static_cast<int>(Reason::kRepeatedImage); ++i) {
    EXPECT_TRUE(names.insert(ToString(static_cast<Reason>(i))).second);
    EXPECT_THAT(std::string(ToString(static_cast<Reason>(i))),
                ::testing::MatchesRegex("[a-z]+(_[a-z]+)*"));
  }
  EXPECT_EQ(names.count("unknown"), 0);
}

/// Returns a keyframe at the origin and a frame 2 units ahead of it.
Trajectory TwoFrames() {
  Trajectory trajectory;
  trajectory.frames = {MakeFrame(10, true), MakeFrame(20, true)};
  trajectory.frames[0].world_from_camera = SE3();
  trajectory.frames[1].world_from_camera = SE3(SO3(), {0, 0, 2});
  trajectory.frames[1].relative_pose = {0, SE3(), SE3::Matrix6::Identity()};
  return trajectory;
}

TEST(TrajectoryTest, RelativePosesFollowThoseInTheWorld) {
  Trajectory trajectory = TwoFrames();
  UpdateRelativePoses(trajectory);
  EXPECT_EQ(trajectory.frames[1].relative_pose->reference_from_camera, SE3(SO3(), {0, 0, 2}));
  trajectory.frames[0].segment = 1;
  UpdateRelativePoses(trajectory);
  EXPECT_FALSE(trajectory.frames[1].relative_pose);
}

TEST(TrajectoryTest, RotationsIncludeFramesWithoutAPose) {
  Trajectory trajectory;
  trajectory.frames = {MakeFrame(10, false), MakeFrame(20, false), MakeFrame(30, true)};
  const SO3 rotation = SO3::Exp(Eigen::Vector3d(0.1, 0.2, 0.3));
  trajectory.frames[1].world_from_camera_rotation = rotation;
  trajectory.frames[2].world_from_camera_rotation = SO3();
  const PoseSequence rotations = trajectory.Rotations();
  ASSERT_EQ(rotations.size(), 2);
  EXPECT_EQ(rotations[0].time_ns, 20);
  EXPECT_EQ(rotations[0].world_from_camera, SE3(rotation, Eigen::Vector3d::Zero()));
  EXPECT_EQ(rotations[1].world_from_camera, SE3());
}

}  // namespace
}  // namespace corvo
