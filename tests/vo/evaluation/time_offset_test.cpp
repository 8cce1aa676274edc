// SPDX-License-Identifier: MIT
#include "vo/evaluation/time_offset.h"

#include <gmock/gmock.h>

#include <cmath>

#include "tests/support/matchers.h"
#include "tests/support/random.h"

namespace corvo {
namespace {

using test::ThrowsError;

constexpr TimeNs kOneSecond = 1'000'000'000;
constexpr TimeNs kFrame = kOneSecond / 20;

Eigen::Vector3d Curve(double t) {
  return {std::sin(0.9 * t) + 0.2 * t, std::cos(0.7 * t), 0.5 * std::sin(1.3 * t)};
}

PoseSequence Along(double first_s, int count, double noise) {
  test::Random random(5);
  PoseSequence poses;
  for (int i = 0; i < count; ++i) {
    const double t = first_s + 0.05 * i;
    const SE3 disturbance = random.Pose(0.1, noise);
    poses.push_back({std::llround(1e9 * t), SE3(SO3(), Curve(t) + disturbance.translation())});
  }
  return poses;
}

TEST(FindTimeOffset, FindsAConstantOffset) {
  const PoseSequence truth = Along(0, 400, 0), estimate = Along(2, 200, 0.005);
  for (const TimeNs offset : {-317'000'000LL, 120'000'000LL, 1'234'000'000LL}) {
    const auto found = FindTimeOffset(ShiftTimes(-offset, estimate), truth);
    ASSERT_TRUE(found) << offset;
    EXPECT_NEAR(static_cast<double>(found->offset_ns), static_cast<double>(offset), 3e6);
    ASSERT_TRUE(found->rmse_without);
    EXPECT_LT(found->rmse, 0.5 * *found->rmse_without);
  }
}

TEST(FindTimeOffset, FindsAnOffsetBetweenClocksThatDoNotOverlap) {
  const PoseSequence truth = ShiftTimes(1'400'000'000 * kOneSecond, Along(0, 400, 0));
  const auto found = FindTimeOffset(Along(2, 200, 0.005), truth);
  ASSERT_TRUE(found);
  EXPECT_NEAR(static_cast<double>(found->offset_ns - 1'400'000'000 * kOneSecond), 0, 3e6);
  EXPECT_FALSE(found->rmse_without);
}

TEST(FindTimeOffset, SuspectsNothingInAccurateOrUnrelatedTrajectories) {
  const PoseSequence truth = Along(0, 400, 0);
  EXPECT_FALSE(FindTimeOffset(Along(2, 200, 0.005), truth));
  EXPECT_FALSE(FindTimeOffset(ShiftTimes(kFrame / 8, Along(2, 200, 0.005)), truth));
  PoseSequence unrelated = Along(2, 200, 0);
  test::Random random(3);
  for (TimedPose& pose : unrelated) pose.world_from_camera = random.Pose(3, 1);
  EXPECT_FALSE(FindTimeOffset(unrelated, truth));
  EXPECT_FALSE(FindTimeOffset({}, truth));
  EXPECT_FALSE(FindTimeOffset(truth, {}));
}

TEST(FindTimeOffset, DoesNotDependOnTheOrigin) {
  PoseSequence truth = Along(0, 400, 0);
  PoseSequence unrelated = Along(2, 200, 0);
  test::Random random(3);
  for (TimedPose& pose : unrelated) pose.world_from_camera = random.Pose(3, 1);
  const SE3 far(SO3(), {3000, -2000, 1000});
  for (TimedPose& pose : truth) pose.world_from_camera = far * pose.world_from_camera;
  EXPECT_FALSE(FindTimeOffset(unrelated, truth));
  EXPECT_FALSE(FindTimeOffset(ShiftTimes(1000 * kOneSecond, unrelated), truth));
  EXPECT_TRUE(FindTimeOffset(ShiftTimes(-kOneSecond, Along(2, 200, 0.005)), truth));
}

TEST(FindTimeOffset, SuspectsNothingInAnInaccurateTrajectoryWhereverTheOriginIs) {
  const PoseSequence rough = ShiftTimes(-kOneSecond, Along(2, 200, 0.6));
  for (const double origin : {0.0, 1000.0}) {
    PoseSequence truth = Along(0, 400, 0);
    for (TimedPose& pose : truth) {
      pose.world_from_camera = SE3(SO3(), {origin, 0, 0}) * pose.world_from_camera;
    }
    EXPECT_FALSE(FindTimeOffset(rough, truth)) << origin;
  }
}

TEST(FindTimeOffset, SuspectsNothingOnAStraightPath) {
  PoseSequence truth;
  for (int i = 0; i < 200; ++i) truth.push_back({i * kFrame, SE3(SO3(), {0.1 * i, 0, 0})});
  EXPECT_FALSE(FindTimeOffset(ShiftTimes(kOneSecond, truth), truth));
  EXPECT_FALSE(FindTimeOffset(ShiftTimes(1000 * kOneSecond, truth), truth));
}

TEST(ShiftTimes, ChecksTheRange) {
  EXPECT_EQ(ShiftTimes(-3, {{5, SE3()}})[0].time_ns, 2);
  EXPECT_THAT([] { ShiftTimes(kMaxTimeNs - 1, {{kMaxTimeNs, SE3()}}); }, ThrowsError("time of"));
}

}  // namespace
}  // namespace corvo
