// SPDX-License-Identifier: MIT
#include "vo/tracking/speed_history.h"

#include <cmath>
#include <vector>

#include <gmock/gmock.h>

namespace corvo {
namespace {

constexpr TimeNs kFrameInterval = 100'000'000;  // 10 Hz
constexpr TimeNs kOneSecondNs = 1'000'000'000;
constexpr double kNormalFromMedian = 1.4826;

/// Drives along x at the given speeds, one for each frame interval, and adds each motion.
class SpeedHistoryTest : public testing::Test {
 protected:
  void Drive(const std::vector<double>& speeds) {
    for (const double speed : speeds) {
      Frame next;
      next.time_ns = frame_.time_ns + kFrameInterval;
      next.world_from_camera =
          SE3(SO3(), frame_.world_from_camera.translation() + Eigen::Vector3d(0.1 * speed, 0, 0));
      history_.Add(frame_, next);
      frame_ = next;
    }
  }

  SegmentStartOptions options_;
  SpeedHistory history_{options_};
  Frame frame_;
};

TEST_F(SpeedHistoryTest, GuessesNothingUntilTheCameraHasMoved) {
  EXPECT_FALSE(history_.Predict(0));
  Drive({0, 0, 0});
  EXPECT_FALSE(history_.Predict(kOneSecondNs));
}

TEST_F(SpeedHistoryTest, GuessIsTheMedianAndIgnoresOneBadStep) {
  Drive({2, 2.1, 1.9, 2, 2.05, 40});
  EXPECT_NEAR(history_.Predict(frame_.time_ns)->speed, 2.05, 1e-9);  // The upper median.
}

TEST_F(SpeedHistoryTest, TheGuessFollowsTheScaleOfAnotherSegment) {
  Drive({2, 2, 2, 2, 2, 2});
  history_.Transform(Sim3(1.5, SO3::Exp({0, 0, 2}), {7, 8, 9}));
  EXPECT_NEAR(history_.Predict(frame_.time_ns)->speed, 3, 1e-9);
}

TEST_F(SpeedHistoryTest, JitterOfAStandingCameraIsNoMotion) {
  Drive({0.01, -0.012, 0.011, -0.009, 0.01, -0.01});
  EXPECT_FALSE(history_.Predict(frame_.time_ns));
  Drive({0.5, 0.5, 0.5, 0.5, 0.5, 0.5});
  EXPECT_TRUE(history_.Predict(frame_.time_ns));
}

TEST_F(SpeedHistoryTest, MotionsOfMoreThanASecondBeforeTheLastAreForgotten) {
  Drive(std::vector<double>(20, 9));
  Drive(std::vector<double>(10, 2));
  const SpeedGuess guess = *history_.Predict(frame_.time_ns);
  EXPECT_NEAR(guess.speed, 2, 1e-9);
  EXPECT_NEAR(guess.log_sigma, 0, 1e-9) << "a motion at another speed remained";
}

TEST_F(SpeedHistoryTest, UncertaintyIsTheSpreadOfTheLogSpeedsAndGrowsWithTheGap) {
  const double a = std::exp(0.2), b = std::exp(-0.2);
  Drive({a, 1, b, a, 1, b, a, 1, b});
  const double spread = kNormalFromMedian * 0.2;
  EXPECT_NEAR(history_.Predict(frame_.time_ns)->log_sigma, spread, 1e-9);
  const SpeedGuess later = *history_.Predict(frame_.time_ns + 3 * kOneSecondNs);
  EXPECT_NEAR(later.speed, 1, 1e-9);
  EXPECT_NEAR(std::pow(later.log_sigma, 2),
              4 * spread * spread + 3 * std::pow(options_.speed_growth, 2), 1e-9);
}

TEST_F(SpeedHistoryTest, SpreadOfAFewSpeedsIsNotTrusted) {
  Drive(std::vector<double>(options_.min_speeds - 1, 2));
  EXPECT_NEAR(history_.Predict(frame_.time_ns)->log_sigma, options_.unknown_speed_spread, 1e-9);
  Drive({2});
  EXPECT_NEAR(history_.Predict(frame_.time_ns)->log_sigma, 0, 1e-9);
}

TEST_F(SpeedHistoryTest, SpeedOfAMotionOverSeveralFramesIsItsAverage) {
  Frame later;
  later.time_ns = 4 * kFrameInterval;
  later.world_from_camera = SE3(SO3(), {0, 0, 2});
  history_.Add(frame_, later);
  EXPECT_NEAR(history_.Predict(later.time_ns)->speed, 5, 1e-9);
}

TEST_F(SpeedHistoryTest, ClearForgetsAllSpeeds) {
  Drive({2, 2, 2});
  history_.Clear();
  EXPECT_FALSE(history_.Predict(frame_.time_ns));
}

}  // namespace
}  // namespace corvo
