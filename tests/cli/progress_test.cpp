// SPDX-License-Identifier: MIT
#include "apps/run/progress.h"

#include <gmock/gmock.h>

namespace corvo {
namespace {

Progress After(int count, int num_frames) {
  Progress progress;
  progress.frame.index = count - 1;
  progress.frame.state = State::kTracking;
  progress.frame.num_inliers = 156;
  progress.num_frames = num_frames;
  progress.frames_per_second = 32.14;
  return progress;
}

TEST(ProgressText, HasFrameStateInliersAndRate) {
  EXPECT_EQ(ProgressText(After(100, 300)),
            "frame 100 of 300: tracking, 156 inliers, 32.1 frames/s, 7 s left");
  EXPECT_EQ(ProgressText(After(300, 300)),
            "frame 300 of 300: tracking, 156 inliers, 32.1 frames/s");
  EXPECT_EQ(ProgressText(After(301, 300)),
            "frame 301 of 300: tracking, 156 inliers, 32.1 frames/s");
}

TEST(DurationText, HasTheUnitOfItsMagnitude) {
  EXPECT_EQ(DurationText(0.1), "1 s");
  EXPECT_EQ(DurationText(59.5), "1:00 min");
  EXPECT_EQ(DurationText(125), "2:05 min");
  EXPECT_EQ(DurationText(3600 + 125), "1:02 h");
}

TEST(ProgressText, OfALiveCameraHasNoTotal) {
  EXPECT_EQ(ProgressText(After(100, 0)), "frame 100: tracking, 156 inliers, 32.1 frames/s");
}

TEST(ShareDone, IsKnownIfTheNumberOfFramesIs) {
  EXPECT_EQ(ShareDone(After(3, 4)), 0.75);
  EXPECT_EQ(ShareDone(After(4, 4)), 1.0);
  EXPECT_EQ(ShareDone(After(7, 0)), std::nullopt);
}

TEST(ProgressBar, LengthIsProportionalToTheShareDone) {
  EXPECT_EQ(ProgressBar(0.75, "text", 15), "[######..] text");
  EXPECT_EQ(ProgressBar(1.0, "text", 1000), "[##############################] text");
}

TEST(ProgressBar, NeverExceedsTheTerminal) {
  const std::string text = ProgressText(After(7, 300));
  for (int columns = 0; columns < 120; ++columns) {
    EXPECT_LE(ProgressBar(7 / 300.0, text, columns).size(), columns);
  }
}

TEST(ProgressBar, IsOmittedIfTheShareIsUnknown) {
  EXPECT_EQ(ProgressBar(std::nullopt, "text", 200), "text");
}

}  // namespace
}  // namespace corvo
