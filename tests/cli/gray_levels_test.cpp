// SPDX-License-Identifier: MIT
#include "apps/dataset/gray_levels.h"

#include <gmock/gmock.h>

#include "apps/dataset/image_source.h"
#include "tests/cli/expect_error.h"
#include "tests/cli/tiny_sequence.h"

namespace corvo::test {
namespace {

using ::testing::HasSubstr;

/// Returns an image of all levels from `low` to `low` + 255 * `step`, as if `step` were the
/// sensor's smallest step.
cv::Mat Ramp(int low, int step) {
  cv::Mat image(4, 256, CV_16UC1);
  for (int x = 0; x < 256; ++x) {
    image.col(x) = cv::Scalar(low + x * step);
  }
  return image;
}

GrayLevels LevelsOf(const cv::Mat& image) {
  GrayHistogram histogram;
  histogram.Add(image);
  return histogram.Levels();
}

TEST(GrayLevels, KeepTheUpperEightBits) {
  for (const int bits : {8, 10, 12, 14, 16}) {
    const GrayLevels levels(bits);
    EXPECT_EQ(levels.Of(0), 0);
    EXPECT_EQ(levels.Of(static_cast<std::uint16_t>((1 << bits) - 1)), 255);
    EXPECT_EQ(levels.Of(static_cast<std::uint16_t>(1 << (bits - 1))), 128);
    EXPECT_EQ(levels.Of(65535), 255);
  }
  EXPECT_THAT(ErrorOf([] { GrayLevels(7); }), HasSubstr("bits is 7"));
  EXPECT_THAT(ErrorOf([] { GrayLevels(17); }), HasSubstr("bits is 17"));
}

TEST(GrayLevels, OfARangeAscendFromBlackToWhite) {
  const GrayLevels levels(7000, 8530);
  EXPECT_EQ(levels.Of(0), 0);
  EXPECT_EQ(levels.Of(7000), 0);
  EXPECT_EQ(levels.Of(7765), 128);
  EXPECT_EQ(levels.Of(8530), 255);
  EXPECT_EQ(levels.Of(65535), 255);
  for (int level = 1; level < 65536; ++level) {
    ASSERT_LE(levels.Of(static_cast<std::uint16_t>(level - 1)),
              levels.Of(static_cast<std::uint16_t>(level)));
  }
}

TEST(GrayHistogram, FindsTheUsedBits) {
  EXPECT_EQ(LevelsOf(Ramp(0, 4)).text(), "10 bits");
  EXPECT_EQ(LevelsOf(Ramp(0, 16)).text(), "12 bits");
  EXPECT_EQ(LevelsOf(Ramp(0, 64)).text(), "14 bits");
  EXPECT_EQ(LevelsOf(Ramp(0, 257)).text(), "16 bits");
  EXPECT_EQ(GrayHistogram().Levels().text(), "10 bits");
}

TEST(GrayHistogram, SpreadsANarrowRange) {
  const GrayLevels levels = LevelsOf(Ramp(7000, 6));
  EXPECT_EQ(levels.text(), "levels 6847 to 8683");
  EXPECT_LT(levels.Of(7000), 30);
  EXPECT_GT(levels.Of(8530), 225);
}

TEST(SixteenBitImages, OfASequenceShareOneMap) {
  const TemporaryFolder folder;
  for (int i = 0; i < 20; ++i) {
    cv::Mat image;
    TinyImage(i).convertTo(image, CV_16U, i < 10 ? 4 : 16);
    WriteImage(folder / (std::to_string(10 + i) + ".png"), image);
  }
  ImageSource found(ListImages(folder.path()));
  cv::Mat expected;
  cv::Mat(TinyImage(0) / 4 - 0.5).convertTo(expected, CV_8U);
  EXPECT_LE(cv::norm(found.Next()->image, expected, cv::NORM_INF), 1) << "12 bits are used";
  InputOptions options;
  options.bits = 10;
  ImageSource stated = OpenImages(folder.path().string(), options, {});
  EXPECT_EQ(cv::norm(stated.Next()->image, TinyImage(0), cv::NORM_INF), 0);
}

}  // namespace
}  // namespace corvo::test
