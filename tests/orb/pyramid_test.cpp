// SPDX-License-Identifier: MIT
#include "orb/pyramid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/orb/images.h"

namespace corvo::orb {
namespace {

using test::NoiseImage;

TEST(OctaveScalesTest, ArePowersOfTheFactor) {
  EXPECT_THAT(OctaveScales(4, 2.0), testing::ElementsAre(1, 2, 4, 8));
  EXPECT_NEAR(OctaveScales(8, 1.2)[7], 3.5831808, 1e-12);
}

TEST(BuildPyramidTest, LevelSizesAreRoundedAndRatiosAreExact) {
  const auto levels = BuildPyramid(NoiseImage({1242, 375}, 4), OctaveScales(8, 1.2));
  ASSERT_EQ(levels.size(), 8U);
  EXPECT_EQ(levels[1].image.size(), cv::Size(1035, 313));  // 312.5 rounds up
  EXPECT_EQ(levels[7].image.size(), cv::Size(347, 105));   // 346.6, 104.7
  EXPECT_DOUBLE_EQ(levels[7].ratio_x, 1242.0 / 347);
  EXPECT_DOUBLE_EQ(levels[7].ratio_y, 375.0 / 105);
}

TEST(BuildPyramidTest, ExtremePixelsMapSymmetrically) {
  for (const auto& level : BuildPyramid(NoiseImage({641, 357}, 5), OctaveScales(8, 1.2))) {
    EXPECT_NEAR(level.InputX(0) + level.InputX(level.image.cols - 1), 640, 1e-9);
    EXPECT_NEAR(level.InputY(0) + level.InputY(level.image.rows - 1), 356, 1e-9);
    EXPECT_NEAR(level.LevelX(level.InputX(12.25)), 12.25, 1e-9);
    EXPECT_NEAR(level.LevelY(level.InputY(3.5)), 3.5, 1e-9);
  }
}

TEST(BuildPyramidTest, FirstLevelIsTheInputAndOthersAreResizedFromThePreviousOne) {
  const cv::Mat image = NoiseImage({100, 80}, 6);
  const auto levels = BuildPyramid(image, OctaveScales(3, 1.5));
  EXPECT_EQ(levels[0].image.data, image.data);
  EXPECT_TRUE(test::SameImage(levels[2].image, Resize(levels[1].image, {44, 36})));
}

TEST(BuildPyramidTest, LevelsHaveAtLeastOnePixel) {
  for (const auto& level : BuildPyramid(NoiseImage({3, 1}, 7), OctaveScales(32, 4.0))) {
    EXPECT_GE(level.image.cols, 1);
    EXPECT_GE(level.image.rows, 1);
  }
}

}  // namespace
}  // namespace corvo::orb
