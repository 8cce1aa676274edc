// SPDX-License-Identifier: MIT
#include "vo/tracking/segment_start.h"

#include <cmath>

#include <gmock/gmock.h>

#include "tests/support/matchers.h"
#include "tests/vo/tracking/posed_frame.h"

namespace corvo {
namespace {

/// Returns a model of a motion by 2 along z in 100 ns.
MotionModel DriveForward() {
  MotionModel motion;
  motion.Update(test::PosedFrame(0, SE3()), test::PosedFrame(100, SE3(SO3(), {0, 0, 2})));
  return motion;
}

TEST(SegmentStartTest, FirstPoseIsPredictedByTheMotionModel) {
  const SE3 pose = PredictFirstPose(test::PosedFrame(150, SE3()), std::nullopt,
                                    test::PosedFrame(100, SE3(SO3(), {0, 0, 2})), DriveForward());
  EXPECT_THAT(pose, test::IsPoseNear(SE3(SO3(), {0, 0, 3}), 1e-9, 1e-9));
}

TEST(SegmentStartTest, FirstFrameOfKnownRotationKeepsThePreviousPosition) {
  const SO3 rotation = SO3::Exp({0, 0.5, 0});
  const SE3 pose = PredictFirstPose(test::PosedFrame(150, SE3()), rotation,
                                    test::PosedFrame(100, SE3(SO3(), {0, 0, 2})), DriveForward());
  EXPECT_THAT(pose, test::IsPoseNear(SE3(rotation, {0, 0, 2}), 1e-9, 1e-9));
}

TEST(SegmentStartTest, MapIsScaledToTheGuessedSpeed) {
  const InitialMap map{SE3(SO3(), {0.1, 0, 0}), {{0, 0, {1, 2, 3}}}};
  const InitialMap scaled = ScaleToSpeed(map, 200'000'000, SpeedGuess{20, 0.5});
  EXPECT_NEAR(scaled.first_from_second.translation().x(), 4, 1e-12);
  EXPECT_THAT(scaled.points[0].in_first, test::IsMatrixNear(Eigen::Vector3d(40, 80, 120), 1e-9));
}

TEST(SegmentStartTest, MapKeepsItsScaleIfNoSpeedIsKnown) {
  const InitialMap map{SE3(SO3(), {0.1, 0, 0}), {{0, 0, {1, 2, 3}}}};
  const InitialMap same = ScaleToSpeed(map, 200, std::nullopt);
  EXPECT_EQ(same.first_from_second, map.first_from_second);
  EXPECT_EQ(same.points[0].in_first, map.points[0].in_first);
}

TEST(SegmentStartTest, ScaleStatesItsOriginAndItsFactor) {
  const SegmentScale guessed = ScaleOf(SpeedGuess{20, std::log(1.5)});
  EXPECT_EQ(guessed.source, ScaleSource::kMedianSpeed);
  EXPECT_NEAR(guessed.factor.value(), 1.5, 1e-12);
  EXPECT_EQ(ScaleOf(std::nullopt), (SegmentScale{ScaleSource::kArbitrary, std::nullopt}));
}

}  // namespace
}  // namespace corvo
