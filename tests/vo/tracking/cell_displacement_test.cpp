// SPDX-License-Identifier: MIT
#include "vo/tracking/cell_displacement.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <cmath>
#include <vector>

#include "tests/vo/tracking/moved_texture.h"

namespace corvo {
namespace {

/// Cells at the bottom have half the height.
cv::Mat MakeTexture() { return test::MakeSmoothTexture(320, 245); }

class ShiftTest : public testing::TestWithParam<cv::Point2d> {};

TEST_P(ShiftTest, IsMeasuredInTexturedCellsAndIsNoChange) {
  const cv::Point2d shift = GetParam();
  const cv::Mat image = MakeTexture();
  CellDisplacement displacement{ReducedImage(image)};
  const std::vector<CellMotion> motion =
      displacement.Measure(ReducedImage(test::Shift(image, shift.x, shift.y)));
  ASSERT_EQ(motion.size(), 32u * 25u);
  int num_textured = 0, num_right = 0;
  for (const CellMotion& cell : motion) {
    if (!cell.is_textured) continue;
    ++num_textured;
    num_right += !cell.is_changed && std::hypot(cell.dx - shift.x, cell.dy - shift.y) < 0.3;
  }
  EXPECT_GT(num_textured, 600);
  EXPECT_GT(num_right, 0.9 * num_textured);
}

INSTANTIATE_TEST_SUITE_P(Shifts, ShiftTest,
                         testing::Values(cv::Point2d(0, 0), cv::Point2d(0.7, 0),
                                         cv::Point2d(0, 0.7), cv::Point2d(-0.5, 0.5)));

TEST(CellDisplacementTest, BrightnessMovesNoCell) {
  const cv::Mat image = MakeTexture();
  CellDisplacement displacement{ReducedImage(image)};
  for (const CellMotion& cell : displacement.Measure(ReducedImage(image + cv::Scalar(20)))) {
    if (!cell.is_textured) continue;
    EXPECT_FALSE(cell.is_changed);
    EXPECT_NEAR(cell.displacement(), 0, 1e-6);
  }
}

TEST(CellDisplacementTest, OtherContentIsAChange) {
  const cv::Mat image = MakeTexture();
  cv::Mat other;
  cv::flip(image, other, 1);
  CellDisplacement displacement{ReducedImage(image)};
  int num_still = 0;
  const std::vector<CellMotion> motion = displacement.Measure(ReducedImage(other));
  for (const CellMotion& cell : motion) num_still += cell.IsStill(0.3);
  EXPECT_LT(num_still, 0.05 * static_cast<double>(motion.size()));
}

TEST(CellDisplacementTest, NothingIsKnownOfCellsWithoutTexture) {
  const cv::Mat gray(245, 320, CV_8UC1, cv::Scalar(100));
  CellDisplacement displacement{ReducedImage(gray)};
  for (const CellMotion& cell : displacement.Measure(ReducedImage(gray))) {
    ASSERT_FALSE(cell.is_textured);
  }
}

}  // namespace
}  // namespace corvo
