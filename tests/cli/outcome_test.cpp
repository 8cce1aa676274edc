// SPDX-License-Identifier: MIT
#include "apps/run/outcome.h"

#include <gmock/gmock.h>

#include "apps/output/reasons.h"
#include "apps/run/run_warnings.h"

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

TEST(JudgeOutcome, IsDoneIfOnlyImagesAreMissing) {
  const FrameResult missing = Unposed(State::kLost, Reason::kUnreadableImage);
  EXPECT_EQ(JudgeOutcome({{Posed(0), missing, Posed(0)}}), Outcome::kDone);
  EXPECT_EQ(JudgeOutcome({{missing, missing}}), Outcome::kNeverInitialized);
  EXPECT_EQ(JudgeOutcome({{Posed(0), missing, kLost, Posed(0)}}), Outcome::kLost);
}

TEST(MissingImageWarning, CountsAndNamesTheFirst) {
  const std::map<Reason, std::string> errors = {{Reason::kWrongSize, "7.png: 3 x 4 px"}};
  EXPECT_EQ(MissingImageWarning(Reason::kWrongSize, {{Reason::kWrongSize, 2}}, errors),
            "2 images were not used (wrong_size), the first: 7.png: 3 x 4 px");
  EXPECT_EQ(MissingImageWarning(Reason::kUnreadableImage, {{Reason::kWrongSize, 2}}, errors), "");
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

TEST(EvidenceWarning, NamesTheParametersThatTheImagesContradict) {
  CalibrationReport report;
  report.estimates = {{"k1", 0, 0.01, 0.001, 1}, {"cx", 619.6, 608.9, 3.2, 0.8}};
  EXPECT_EQ(EvidenceWarning(report), "");
  report.estimates[1].is_contradicted = true;
  EXPECT_THAT(EvidenceWarning(report), testing::HasSubstr("cx 608.9 ± 3.2 (given: 619.6)"));
  EXPECT_THAT(EvidenceWarning(report), testing::Not(testing::HasSubstr("k1")));
}

TEST(ContradictionWarning, TellsAContradictedCameraFromOneThatChanges) {
  CalibrationReport report;
  EXPECT_EQ(ContradictionWarning(report), "");
  report.prior_rejected = true;
  EXPECT_THAT(ContradictionWarning(report), testing::HasSubstr("contradict the given camera"));
  EXPECT_EQ(DisagreementWarning(report), "");
  report.is_consistent = false;
  EXPECT_THAT(DisagreementWarning(report), testing::HasSubstr("it was zoomed or focused"));
}

TEST(MisfitWarning, NamesTheParametersWithBothValues) {
  EXPECT_EQ(MisfitWarning({}), "");
  EXPECT_EQ(MisfitWarning({{"cy", 193.2, 183, 1.5}, {"focal", 700, 712, 2}}),
            "the map fits another calibration than the given one: cy 183 ± 1.5 (used: 193.2), fx "
            "712 ± 2 (used: 700)");
}

TEST(ScaleWarning, NamesTheFramesWhoseScaleIsUncertain) {
  Trajectory trajectory;
  for (int i = 0; i < 60; ++i) {
    trajectory.frames.push_back(Posed(0));
    trajectory.frames.back().index = i;
    const bool is_uncertain = i == 12 || i == 15 || (i >= 40 && i < 50);
    if (is_uncertain) trajectory.frames.back().reason = Reason::kScaleUncertain;
  }
  const std::vector<FrameRange> ranges = UncertainScaleRanges(trajectory);
  EXPECT_THAT(ranges, testing::ElementsAre(FrameRange{12, 15}, FrameRange{40, 49}));
  EXPECT_THAT(ScaleWarning(ranges), testing::HasSubstr("in the frames 12-15, 40-49:"));
  EXPECT_EQ(ScaleWarning({}), "");
  EXPECT_TRUE(CountReasons(trajectory).empty());
}

TEST(BlurWarning, CountsFramesWhoseDetailsAreCoarserThanThoseOfTheSharpest) {
  Trajectory trajectory;
  for (int i = 0; i < 60; ++i) {
    trajectory.frames.push_back(Posed(0));
    trajectory.frames.back().finest_octave = i < 20 ? 1 : 2;
  }
  const auto warning = [&] { return BlurWarning(CountBlurredFrames(trajectory), 60); };
  EXPECT_EQ(warning(), "");
  for (int i = 30; i < 50; ++i) trajectory.frames[i].finest_octave = 4;
  EXPECT_EQ(CountBlurredFrames(trajectory), 20);
  EXPECT_THAT(warning(), testing::StartsWith("20 of 60 frames are blurred"));
  EXPECT_EQ(BlurWarning(CountBlurredFrames({}), 0), "");
}

}  // namespace
}  // namespace corvo
