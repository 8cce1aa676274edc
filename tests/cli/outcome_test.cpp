// SPDX-License-Identifier: MIT
#include "apps/run/outcome.h"

#include <gmock/gmock.h>

#include "apps/output/reasons.h"

namespace corvo {
namespace {

FrameResult Posed(int segment) {
  FrameResult frame;
  frame.state = State::kTracking;
  frame.segment = segment;
  frame.world_from_camera = SE3();
  return frame;
}

FrameResult Unposed(State state, Reason reason) {
  FrameResult frame;
  frame.state = state;
  frame.reason = reason;
  return frame;
}

const FrameResult kWaiting = Unposed(State::kInitializing, Reason::kLowParallax);
const FrameResult kTurned = Unposed(State::kRotationOnly, Reason::kRotationOnly);
const FrameResult kLost = Unposed(State::kLost, Reason::kTooFewInliers);

TEST(JudgeOutcome, IsDoneIfTrackedFromInitializationToTheEnd) {
  EXPECT_EQ(JudgeOutcome({{Posed(0), Posed(0)}}), Outcome::kDone);
  EXPECT_EQ(JudgeOutcome({{kWaiting, kWaiting, Posed(0)}}), Outcome::kDone);
}

TEST(JudgeOutcome, IsNeverInitializedWithoutAPose) {
  EXPECT_EQ(JudgeOutcome({}), Outcome::kNeverInitialized);
  EXPECT_EQ(JudgeOutcome({{kWaiting, kWaiting}}), Outcome::kNeverInitialized);
}

TEST(JudgeOutcome, IsLostAfterAGapOrInSeveralSegments) {
  EXPECT_EQ(JudgeOutcome({{Posed(0), kLost}}), Outcome::kLost);
  EXPECT_EQ(JudgeOutcome({{Posed(0), kLost, Posed(0)}}), Outcome::kLost);
  EXPECT_EQ(JudgeOutcome({{Posed(0), kTurned, Posed(0)}}), Outcome::kLost);
  EXPECT_EQ(JudgeOutcome({{Posed(0), Posed(1)}}), Outcome::kLost);
}

TEST(Advice, IsGivenForEveryReason) {
  for (int reason = 0; ToString(static_cast<Reason>(reason)) != "unknown"; ++reason) {
    EXPECT_FALSE(Advice(static_cast<Reason>(reason)).empty())
        << ToString(static_cast<Reason>(reason));
  }
}

TEST(CountReasons, CountsFramesWithoutAPose) {
  const Trajectory trajectory{{kWaiting, kWaiting, Posed(0), kLost}};
  EXPECT_THAT(CountReasons(trajectory),
              testing::ElementsAre(testing::Pair(Reason::kLowParallax, 2),
                                   testing::Pair(Reason::kTooFewInliers, 1)));
}

}  // namespace
}  // namespace corvo
