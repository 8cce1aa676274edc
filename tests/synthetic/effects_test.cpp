// SPDX-License-Identifier: MIT
#include "apps/synthetic/effects.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "apps/synthetic/sequence.h"
#include "tests/support/matchers.h"

namespace corvo::synthetic {
namespace {

using test::ThrowsError;

/// Makes a sequence of a planar wall, 128 x 96 px at 30 Hz.
Sequence SmallWall(int frames, const Effects& effects) {
  SequenceOptions options;
  options.frames = frames;
  options.width = 128;
  options.effects = effects;
  return MakePlanarWall(options);
}

bool SameImage(const cv::Mat& a, const cv::Mat& b) { return cv::norm(a, b, cv::NORM_INF) == 0; }

double MeanGradient(const cv::Mat& image) {
  const cv::Mat left = image.colRange(0, image.cols - 1), right = image.colRange(1, image.cols);
  return cv::norm(left, right, cv::NORM_L1) / static_cast<double>(left.total());
}

cv::Mat Gray(int value) { return cv::Mat(95, 127, CV_8UC1, cv::Scalar(value)); }

TEST(TimeSpanTest, IncludesItsStartButNotItsEnd) {
  const TimeSpan span{2, 1.5};
  EXPECT_FALSE(span.Contains(1.999));
  EXPECT_TRUE(span.Contains(2));
  EXPECT_TRUE(span.Contains(3.499));
  EXPECT_FALSE(span.Contains(3.5));
  EXPECT_FALSE(TimeSpan().Contains(0));
}

TEST(ApplyLightTest, WithoutEffectsTheImageIsUnchanged) {
  cv::Mat image = Gray(200);
  ApplyLight(&image, {}, 1);
  EXPECT_TRUE(SameImage(image, Gray(200)));
}

TEST(ApplyLightTest, DarkImagesAreAlmostBlack) {
  Effects effects;
  effects.dark = {1, 2};
  cv::Mat image = Gray(200);
  ApplyLight(&image, effects, 2);
  EXPECT_TRUE(SameImage(image, Gray(4)));
  ApplyLight(&image, effects, 3);
  EXPECT_TRUE(SameImage(image, Gray(4)));
}

TEST(ApplyLightTest, ExposureOscillatesByTheGivenStops) {
  Effects effects;
  effects.exposure_drift = 1.5;
  EXPECT_DOUBLE_EQ(Brightness(effects, 0), 1);
  EXPECT_DOUBLE_EQ(Brightness(effects, 2), std::exp2(1.5));
  EXPECT_DOUBLE_EQ(Brightness(effects, 6), std::exp2(-1.5));
  cv::Mat image = Gray(40), bright = Gray(100);
  effects.exposure_drift = 2;
  ApplyLight(&image, effects, 2);
  ApplyLight(&bright, effects, 2);
  EXPECT_TRUE(SameImage(image, Gray(160)));
  EXPECT_TRUE(SameImage(bright, Gray(255))) << "saturated";
}

TEST(ApplyLightTest, VignettingDarkensTheCornersByTheGivenShare) {
  Effects effects;
  effects.vignetting = 0.6;
  cv::Mat image = Gray(200);
  ApplyLight(&image, effects, 0);
  EXPECT_EQ(image.at<std::uint8_t>(47, 63), 200);
  for (const cv::Point& corner :
       {cv::Point(0, 0), cv::Point(126, 0), cv::Point(0, 94), cv::Point(126, 94)}) {
    EXPECT_EQ(image.at<std::uint8_t>(corner), 80);
  }
}

TEST(SequenceEffectsTest, OnlyFramesInTheDarkTimeSpanAreDark) {
  Effects effects;
  effects.dark = {2 / 30.0 - 1e-6, 2 / 30.0};  // Frames 2 and 3.
  const Sequence sequence = SmallWall(6, effects), clean = SmallWall(6, {});
  for (int i = 0; i < 6; ++i) {
    double brightest = 0;
    cv::minMaxLoc(sequence.Render(i), nullptr, &brightest);
    if (i == 2 || i == 3) {
      EXPECT_LE(brightest, 5);
    } else {
      EXPECT_TRUE(SameImage(sequence.Render(i), clean.Render(i))) << i;
    }
    EXPECT_EQ(sequence.poses()[i].world_from_camera, clean.poses()[i].world_from_camera);
  }
}

TEST(SequenceEffectsTest, BlurAveragesOverTheFrameTime) {
  Effects effects;
  effects.blur = {0.3, 0.1};  // Frames 9 to 11.
  const Sequence sequence = SmallWall(20, effects), clean = SmallWall(20, {});
  EXPECT_TRUE(SameImage(sequence.Render(8), clean.Render(8)));
  EXPECT_TRUE(SameImage(sequence.Render(12), clean.Render(12)));
  const cv::Mat blurred = sequence.Render(10), sharp = clean.Render(10);
  EXPECT_LT(MeanGradient(blurred), 0.9 * MeanGradient(sharp));
  EXPECT_LT(cv::norm(blurred, sharp, cv::NORM_L1),
            cv::norm(blurred, clean.Render(11), cv::NORM_L1));
  EXPECT_LT(cv::norm(blurred, sharp, cv::NORM_L1), cv::norm(blurred, clean.Render(9), cv::NORM_L1));
}

TEST(SequenceEffectsTest, WithoutMotionThereIsNoBlur) {
  Effects effects;
  effects.blur = {0, 1};
  EXPECT_TRUE(SameImage(SmallWall(1, effects).Render(0), SmallWall(1, {}).Render(0)));
}

/// Returns a mask of the pixels that show a board, according to their depth.
cv::Mat BoardMask(const Sequence& sequence, int frame) {
  return sequence.RenderDepth(frame) < 0.81;
}

TEST(SequenceEffectsTest, MovingBoardsCoverTheGivenShareOfTheImage) {
  for (const double share : {0.1, 0.3, 0.7}) {
    Effects effects;
    effects.moving_share = share;
    const Sequence sequence = SmallWall(41, effects), clean = SmallWall(41, {});
    for (const int frame : {0, 40}) {
      const cv::Mat mask = BoardMask(sequence, frame);
      const double hidden = cv::countNonZero(mask) / static_cast<double>(mask.total());
      EXPECT_NEAR(hidden, share, 0.02);
      cv::Mat difference;
      cv::absdiff(sequence.Render(frame), clean.Render(frame), difference);
      EXPECT_GT(cv::countNonZero(difference & mask), 0.8 * cv::countNonZero(mask));
    }
    const cv::Mat moved = BoardMask(sequence, 0) != BoardMask(sequence, 40);
    EXPECT_GT(cv::countNonZero(moved), 200);
    EXPECT_EQ(sequence.poses()[40].world_from_camera, clean.poses()[40].world_from_camera);
  }
}

TEST(SequenceEffectsTest, MovingBoardsDoNotChangeTheRestOfTheImage) {
  Effects effects;
  effects.moving_share = 0.3;
  const Sequence sequence = SmallWall(3, effects);
  cv::Mat difference;
  cv::absdiff(sequence.Render(2), SmallWall(3, {}).Render(2), difference);
  cv::Mat elsewhere = BoardMask(sequence, 2) == 0;
  for (int i = 0; i < 2; ++i) {  // Excludes the edges, which mix both.
    const cv::Mat all = elsewhere.clone();
    const cv::Range rows(1, all.rows - 1), columns(1, all.cols - 1);
    for (const auto& [dx, dy] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
      elsewhere(rows, columns) &= all(cv::Range(rows.start + dy, rows.end + dy),
                                      cv::Range(columns.start + dx, columns.end + dx));
    }
  }
  EXPECT_GT(cv::countNonZero(elsewhere), 1000);
  EXPECT_EQ(cv::countNonZero(difference & elsewhere), 0);
}

TEST(EffectsTest, ErrorsNameTheFieldOutOfRange) {
  const auto making = [](auto change) {
    return [change] {
      Effects effects;
      change(effects);
      SmallWall(1, effects);
    };
  };
  EXPECT_THAT(making([](Effects& e) { e.dark.start_s = -1; }), ThrowsError("dark start is -1"));
  EXPECT_THAT(making([](Effects& e) { e.blur.duration_s = -2; }), ThrowsError("blur duration"));
  EXPECT_THAT(making([](Effects& e) { e.exposure_drift = 4; }),
              ThrowsError("exposure_drift is 4; allowed is 0 to 3"));
  EXPECT_THAT(making([](Effects& e) { e.vignetting = std::nan(""); }), ThrowsError("vignetting"));
  EXPECT_THAT(making([](Effects& e) { e.moving_share = 0.9; }), ThrowsError("moving_share"));
}

}  // namespace
}  // namespace corvo::synthetic
