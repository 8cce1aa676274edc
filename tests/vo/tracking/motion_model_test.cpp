// SPDX-License-Identifier: MIT
#include "vo/tracking/motion_model.h"

#include <gmock/gmock.h>

#include "tests/support/matchers.h"
#include "tests/vo/tracking/posed_frame.h"

namespace corvo {
namespace {

TEST(MotionModelTest, PredictsTheSamePoseBeforeAnyMotionIsKnown) {
  const SE3 pose(SO3::Exp({0.1, 0.2, 0.3}), {1, 2, 3});
  const MotionModel motion;
  EXPECT_THAT(motion.Predict(test::PosedFrame(5, pose), 100), test::IsPoseNear(pose, 1e-12, 1e-12));
}

TEST(MotionModelTest, PredictsTheLastMotionInProportionToTime) {
  const SE3 start(SO3::Exp({0.1, 0.2, 0.3}), {1, 2, 3});
  const SE3 step(SO3::Exp({0, 0.02, 0}), {0.1, 0, 0.5});
  const Frame earlier = test::PosedFrame(100, start), later = test::PosedFrame(200, start * step);
  MotionModel motion;
  motion.Update(earlier, later);
  EXPECT_THAT(motion.Predict(later, 300), test::IsPoseNear(start * step * step, 1e-9, 1e-9));
  EXPECT_THAT(motion.Predict(later, 100), test::IsPoseNear(start, 1e-9, 1e-9));
  EXPECT_THAT(motion.Predict(later, 250),
              test::IsPoseNear(start * step * step.Power(0.5), 1e-9, 1e-9));
}

TEST(MotionModelTest, ACameraMayHaveStoppedAndAClockMayStutter) {
  const SE3 start(SO3::Exp({0.1, 0.2, 0.3}), {1, 2, 3});
  const SE3 step(SO3::Exp({0, 0.02, 0}), {0.1, 0, 0.5});
  const Frame earlier = test::PosedFrame(100, start), later = test::PosedFrame(200, start * step);
  MotionModel motion;
  EXPECT_THAT(motion.PredictAlternatives(later, 300), testing::SizeIs(1));
  motion.Update(earlier, later);
  const std::vector<SE3> regular = motion.PredictAlternatives(later, 300);
  ASSERT_THAT(regular, testing::SizeIs(2));
  EXPECT_THAT(regular[0], test::IsPoseNear(start * step * step, 1e-9, 1e-9));
  EXPECT_THAT(regular[1], test::IsPoseNear(start * step, 1e-9, 1e-9));
  const std::vector<SE3> stuttering = motion.PredictAlternatives(later, 210);
  ASSERT_THAT(stuttering, testing::SizeIs(3));
  EXPECT_THAT(stuttering[0], test::IsPoseNear(start * step * step.Power(0.1), 1e-9, 1e-9));
  EXPECT_THAT(stuttering[1], test::IsPoseNear(start * step * step, 1e-9, 1e-9));
  EXPECT_THAT(stuttering[2], test::IsPoseNear(start * step, 1e-9, 1e-9));
}

}  // namespace
}  // namespace corvo
