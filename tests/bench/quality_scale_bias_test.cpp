// SPDX-License-Identifier: MIT
#include "bench/quality/scale_bias.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace corvo::bench {
namespace {

constexpr double kReachPx = 6;
const cv::Size kSize(640, 480);

cv::KeyPoint At(double x, double y, int octave) {
  return {cv::Point2f(static_cast<float>(x), static_cast<float>(y)), 31, -1, 0, octave};
}

/// Measures points that are detected with an error of `bias` in the image and in the image rotated
/// by 180 degrees.
std::vector<OctaveBias> MeasureWith(const cv::Point2d& bias, int octave) {
  std::vector<cv::KeyPoint> points, turned;
  for (int i = 0; i < 20; ++i) {
    const double x = 20 + 30 * i, y = 20 + 20 * (i % 7);
    points.push_back(At(x + bias.x, y + bias.y, octave));
    turned.push_back(At(639 - x + bias.x, 479 - y + bias.y, octave));
  }
  return MeasureBias(points, turned, kSize, kReachPx);
}

TEST(ScaleBiasTest, IsZeroForExactPoints) {
  const auto biases = MeasureWith({0, 0}, 3);
  ASSERT_EQ(biases.size(), 1U);
  EXPECT_EQ(biases[0].octave, 3);
  EXPECT_EQ(biases[0].pairs, 20);
  EXPECT_EQ(biases[0].px, cv::Point2d(0, 0));
}

TEST(ScaleBiasTest, FindsAConstantError) {
  const auto biases = MeasureWith({1.25, -0.5}, 0);
  ASSERT_EQ(biases.size(), 1U);
  EXPECT_EQ(biases[0].pairs, 20);
  EXPECT_EQ(biases[0].px, cv::Point2d(1.25, -0.5));
}

TEST(ScaleBiasTest, PairsShareAnOctaveAndAreNear) {
  EXPECT_THAT(MeasureBias({At(10, 10, 0)}, {At(629, 469, 1)}, kSize, kReachPx), testing::IsEmpty());
  EXPECT_THAT(MeasureBias({At(10, 10, 0)}, {At(620, 469, 0)}, kSize, kReachPx), testing::IsEmpty());
  const auto biases =
      MeasureBias({At(10, 10, 0), At(12, 10, 0)}, {At(629, 469, 0)}, kSize, kReachPx);
  ASSERT_EQ(biases.size(), 1U);
  EXPECT_EQ(biases[0].pairs, 1);
  EXPECT_EQ(biases[0].px, cv::Point2d(0, 0));
}

TEST(ScaleBiasTest, OctavesAreMergedWeightedByTheirPairs) {
  const auto merged = MergeOctaves({{1, 1, {4, 0}}, {0, 2, {1, 1}}, {1, 3, {0, 4}}});
  ASSERT_EQ(merged.size(), 2U);
  EXPECT_EQ(merged[0].octave, 0);
  EXPECT_EQ(merged[1].pairs, 4);
  EXPECT_EQ(merged[1].px, cv::Point2d(1, 3));
}

}  // namespace
}  // namespace corvo::bench
