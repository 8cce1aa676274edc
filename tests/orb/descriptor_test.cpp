// SPDX-License-Identifier: MIT
#include "orb/descriptor.h"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

#include "orb/window_sums.h"
#include "tests/orb/images.h"
#include "tests/orb/pattern_access.h"

namespace corvo::orb {
namespace {

/// Describes the center of a 43 x 43 image.
Descriptor DescribeCenter(const cv::Mat& image, const Describer& describer, float angle_deg) {
  const cv::Mat sums = WindowSums(image);
  return describer.Describe(sums.ptr<std::uint16_t>(21) + 21, 43, angle_deg);
}

/// Describes the center of a 43 x 43 image in direction `bin` of `bins`.
Descriptor DescribeCenter(const cv::Mat& image, int bin, int bins) {
  const Describer describer(MakeBriefPattern(), bins, false);
  return DescribeCenter(image, describer, 360.0F * static_cast<float>(bin) / bins);
}

TEST(DescriberTest, BitIsOneWhereTheWindowAtPIsDarker) {
  const cv::Mat image = test::NoiseImage({43, 43}, 2);
  const RotatedPatterns patterns(MakeBriefPattern(), 30);
  for (int bin = 0; bin < 30; ++bin) {
    const Descriptor descriptor = DescribeCenter(image, bin, 30);
    for (int i = 0; i < kNumTests; ++i) {
      const auto& [p, q] = patterns[bin][i];
      const bool darker =
          test::WindowSum(image, 21 + p.x, 21 + p.y) < test::WindowSum(image, 21 + q.x, 21 + q.y);
      ASSERT_EQ(test::Bit(descriptor, i), darker) << "test " << i;
    }
  }
}

TEST(DescriberTest, UprightIgnoresTheAngle) {
  const cv::Mat image = test::NoiseImage({43, 43}, 5);
  const Describer upright(MakeBriefPattern(), 30, true);
  EXPECT_EQ(DescribeCenter(image, upright, 0), DescribeCenter(image, 0, 30));
  EXPECT_EQ(DescribeCenter(image, upright, 200), DescribeCenter(image, 0, 30));
}

TEST(DescriberTest, EqualSumsGiveZeroBits) {
  EXPECT_EQ(DescribeCenter(cv::Mat(43, 43, CV_8UC1, cv::Scalar(90)), 0, 30), Descriptor{});
}

TEST(DescriberTest, DescriptorIsInvariantToGainAndOffset) {
  const cv::Mat image = test::NoiseImage({43, 43}, 3) / 4;  // 0 to 64
  const cv::Mat brighter = 3 * image + cv::Scalar(60);      // to 252, nothing saturates
  EXPECT_EQ(DescribeCenter(brighter, 1, 30), DescribeCenter(image, 1, 30));
}

TEST(DescriberTest, RotatingImageAndAngleGivesTheSameDescriptor) {
  const cv::Mat image = test::NoiseImage({43, 43}, 4);
  cv::Mat turned;
  cv::rotate(image, turned, cv::ROTATE_90_CLOCKWISE);
  for (int bin = 0; bin < 27; ++bin) {
    EXPECT_EQ(DescribeCenter(turned, bin + 9, 36), DescribeCenter(image, bin, 36));
  }
}

}  // namespace
}  // namespace corvo::orb
