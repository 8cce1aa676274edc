#include "apps/progress.h"

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
            "frame 100 of 300: tracking, 156 inliers, 32.1 frames/s");
}

TEST(ProgressText, OfACameraHasNoEnd) {
  EXPECT_EQ(ProgressText(After(100, 0)), "frame 100: tracking, 156 inliers, 32.1 frames/s");
}

TEST(ProgressBar, IsAsLongAsTheShareDone) {
  const std::string text = ProgressText(After(3, 4));
  EXPECT_EQ(ProgressBar(After(3, 4), static_cast<int>(text.size()) + 11), "[######..] " + text);
  EXPECT_EQ(ProgressBar(After(4, 4), 1000),
            "[##############################] " + ProgressText(After(4, 4)));
}

TEST(ProgressBar, NeverExceedsTheTerminal) {
  for (int columns = 0; columns < 120; ++columns) {
    EXPECT_LE(ProgressBar(After(7, 300), columns).size(), columns);
  }
}

TEST(ProgressBar, IsLeftOutWithoutAnEnd) {
  EXPECT_EQ(ProgressBar(After(7, 0), 200), ProgressText(After(7, 0)));
}

}  // namespace
}  // namespace corvo
