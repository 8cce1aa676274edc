// SPDX-License-Identifier: MIT
#include "orb/harris.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/orb/images.h"

namespace corvo::orb {
namespace {

/// Returns a dark image with a bright lower right quadrant if `corner`, else with a bright right
/// half.
cv::Mat StepImage(bool corner) {
  cv::Mat image(40, 40, CV_8UC1, cv::Scalar(20));
  image(cv::Rect(20, corner ? 20 : 0, 20, corner ? 20 : 40)) = cv::Scalar(220);
  return image;
}

TEST(HarrisResponseTest, FlatIsZeroEdgeNegativeCornerPositive) {
  const cv::Mat flat(40, 40, CV_8UC1, cv::Scalar(77));
  EXPECT_EQ(HarrisResponse(flat, 20, 20), 0);
  EXPECT_LT(HarrisResponse(StepImage(false), 20, 20), 0);
  EXPECT_GT(HarrisResponse(StepImage(true), 20, 20), 0);
}

TEST(HarrisResponseTest, EqualsTheDefinitionWithSobelGradients) {
  const cv::Mat image = test::NoiseImage({40, 30}, 1);
  cv::Mat gx, gy;
  cv::Sobel(image, gx, CV_64F, 1, 0);
  cv::Sobel(image, gy, CV_64F, 0, 1);
  for (int y = 4; y < 26; ++y) {
    for (int x = 4; x < 36; ++x) {
      const cv::Rect window(x - 3, y - 3, 7, 7);
      const double xx = gx(window).dot(gx(window));
      const double xy = gx(window).dot(gy(window));
      const double yy = gy(window).dot(gy(window));
      const double expected = 25 * (xx * yy - xy * xy) - (xx + yy) * (xx + yy);
      ASSERT_NEAR(static_cast<double>(HarrisResponse(image, x, y)), expected,
                  1e-9 * std::abs(expected) + 1);
    }
  }
}

TEST(HarrisResponseTest, TheStrongestContrastDoesNotOverflow) {
  cv::Mat image(20, 20, CV_8UC1);
  for (int y = 0; y < 20; ++y) {
    for (int x = 0; x < 20; ++x) {
      image.at<std::uint8_t>(y, x) = (x / 2 + y / 2) % 2 == 0 ? 0 : 255;
    }
  }
  EXPECT_GT(HarrisResponse(image, 10, 10), 0);
}

TEST(HarrisResponseTest, IsInvariantToQuarterTurns) {
  const cv::Mat image = test::NoiseImage({31, 31}, 2);
  cv::Mat turned;
  cv::rotate(image, turned, cv::ROTATE_90_CLOCKWISE);
  EXPECT_EQ(HarrisResponse(turned, 30 - 9, 12), HarrisResponse(image, 12, 9));
}

}  // namespace
}  // namespace corvo::orb
