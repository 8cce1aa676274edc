// SPDX-License-Identifier: MIT
#include "orb/window_sums.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "tests/orb/images.h"

namespace corvo::orb {
namespace {

TEST(WindowSumsTest, AreExactSumsOf25Pixels) {
  const cv::Mat image = test::NoiseImage({53, 31}, 1);
  const cv::Mat sums = WindowSums(image);
  ASSERT_EQ(sums.type(), CV_16UC1);
  ASSERT_EQ(sums.size(), image.size());
  for (int y = 2; y < image.rows - 2; ++y) {
    for (int x = 2; x < image.cols - 2; ++x) {
      ASSERT_EQ(sums.at<std::uint16_t>(y, x), test::WindowSum(image, x, y));
    }
  }
}

TEST(WindowSumsTest, WhiteIsNotSaturatedAndTinyImagesAreZero) {
  const cv::Mat white(5, 5, CV_8UC1, cv::Scalar(255));
  EXPECT_EQ(WindowSums(white).at<std::uint16_t>(2, 2), 25 * 255);
  EXPECT_EQ(cv::countNonZero(WindowSums(white)), 1);
  EXPECT_EQ(cv::countNonZero(WindowSums(white(cv::Rect(0, 0, 4, 4)))), 0);
}

/// Returns whether the band's rows around `y` equal those of the whole image.
bool IsAround(WindowSumBand& band, int y, const cv::Mat& expected) {
  const std::uint16_t* row = band.Row(y);
  for (int dy = -WindowSumBand::kReach; dy <= WindowSumBand::kReach; ++dy) {
    const std::uint16_t* sums = row + dy * band.stride();
    if (!std::equal(sums + 2, sums + expected.cols - 2, expected.ptr<std::uint16_t>(y + dy) + 2)) {
      return false;
    }
  }
  return true;
}

TEST(WindowSumBandTest, ReturnsTheSumsAroundAnyRow) {
  const cv::Mat image = test::NoiseImage({60, 400}, 1);
  const cv::Mat expected = WindowSums(image);
  WindowSumBand band;
  for (const std::vector<int>& rows : {std::vector<int>{20, 20, 21, 83, 84, 85, 300, 379},
                                       std::vector<int>{379, 20, 200, 199, 236, 237, 264, 265}}) {
    band.Start(image);
    for (const int y : rows) EXPECT_TRUE(IsAround(band, y, expected)) << y;
  }
}

TEST(WindowSumBandTest, StartResetsTheBandForAnotherImage) {
  WindowSumBand band;
  const cv::Mat first = test::NoiseImage({60, 50}, 2);
  band.Start(first);
  band.Row(25);
  const cv::Mat image = test::NoiseImage({44, 41}, 3);
  band.Start(image);
  EXPECT_TRUE(IsAround(band, 20, WindowSums(image)));
}

}  // namespace
}  // namespace corvo::orb
