// SPDX-License-Identifier: MIT
#include "vo/tracking/static_overlay.h"

#include <gtest/gtest.h>

#include "tests/vo/two_walls.h"

namespace corvo {
namespace {

const cv::Size kSize(640, 480);

/// Covers the bottom `share` of an image with texture that is always the same.
cv::Mat CoverBottom(const cv::Mat& image, double share) {
  cv::Mat covered = image.clone();
  const cv::Mat texture = test::MakeTexture(image.cols, image.rows, 99);
  const int top = static_cast<int>(image.rows * (1 - share));
  texture.rowRange(top, image.rows).copyTo(covered.rowRange(top, image.rows));
  return covered;
}

double MaskedShareOf(const StaticOverlay& overlay, const cv::Rect& region) {
  const cv::Mat used = overlay.Exclude(cv::Mat(), kSize);
  if (used.empty()) return 0;
  return 1 - cv::countNonZero(used(region)) / static_cast<double>(region.area());
}

class StaticOverlayTest : public testing::TestWithParam<double> {};

TEST_P(StaticOverlayTest, IsMaskedAndTheSceneIsNot) {
  StaticOverlay overlay;
  for (const cv::Mat& image : test::MakeDrive(20, 3)) {
    overlay.Add(ReducedImage(CoverBottom(image, GetParam())));
  }
  const int top = static_cast<int>(kSize.height * (1 - GetParam()));
  EXPECT_GT(MaskedShareOf(overlay, {0, top, kSize.width, kSize.height - top}), 0.9);
  EXPECT_EQ(MaskedShareOf(overlay, {0, 0, kSize.width, top - 60}), 0);
}

INSTANTIATE_TEST_SUITE_P(Shares, StaticOverlayTest, testing::Values(0.1, 0.2, 0.3, 0.4),
                         [](const auto& param_info) {
                           return std::to_string(static_cast<int>(100 * param_info.param));
                         });

/// The height of these images is not a multiple of that of the cells.
TEST(StaticOverlayFoundTest, IsMaskedAtTheBorderOfAnImageOfAnySize) {
  const cv::Size size(600, 430);
  StaticOverlay overlay;
  for (const cv::Mat& image : test::MakeDrive(20, 3)) {
    const cv::Mat part = CoverBottom(image(cv::Rect(cv::Point(), size)), 0.05);
    overlay.Add(ReducedImage(part));
  }
  EXPECT_GT(overlay.masked_share(), 0.03);
}

TEST(StaticOverlayFoundTest, NothingIsMaskedWhileTheCameraStands) {
  StaticOverlay overlay;
  const cv::Mat image = test::TwoWalls(4).Render(0);
  for (int i = 0; i < 50; ++i) EXPECT_FALSE(overlay.Add(ReducedImage(image)));
  EXPECT_EQ(overlay.masked_share(), 0);
}

TEST(StaticOverlayFoundTest, NothingIsMaskedInASceneThatMoves) {
  StaticOverlay overlay;
  for (const cv::Mat& image : test::MakeDrive(60, 5)) overlay.Add(ReducedImage(image));
  EXPECT_EQ(overlay.masked_share(), 0);
}

TEST(StaticOverlayFoundTest, IsReleasedWhenItMoves) {
  StaticOverlay overlay;
  const std::vector<cv::Mat> drive = test::MakeDrive(60, 6);
  for (int i = 0; i < 20; ++i) overlay.Add(ReducedImage(CoverBottom(drive[i], 0.3)));
  EXPECT_GT(overlay.masked_share(), 0.2);
  for (int i = 20; i < 60; ++i) overlay.Add(ReducedImage(drive[i]));
  EXPECT_EQ(overlay.masked_share(), 0);
}

TEST(StaticOverlayFoundTest, TheGivenMaskStaysInForce) {
  StaticOverlay overlay;
  for (const cv::Mat& image : test::MakeDrive(20, 3)) {
    overlay.Add(ReducedImage(CoverBottom(image, 0.3)));
  }
  cv::Mat mask(kSize, CV_8U, cv::Scalar(255));
  mask.colRange(0, 100) = 0;
  const cv::Mat used = overlay.Exclude(mask, kSize);
  EXPECT_EQ(cv::countNonZero(used.colRange(0, 100)), 0);
  EXPECT_EQ(cv::countNonZero(used.rowRange(400, 480)), 0);
  EXPECT_GT(cv::countNonZero(used), 0);
}

}  // namespace
}  // namespace corvo
