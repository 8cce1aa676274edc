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
using test::ShapesImage;

bool SameImage(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && cv::countNonZero(a != b) == 0;
}

const std::vector<std::pair<cv::Size, cv::Size>> kResizes = {
    {{640, 480}, {533, 400}}, {{101, 67}, {84, 56}}, {{64, 64}, {32, 32}},
    {{50, 31}, {13, 8}},      {{7, 5}, {1, 1}},      {{1, 1}, {1, 1}}};

TEST(OctaveScalesTest, ArePowersOfTheFactor) {
  EXPECT_THAT(OctaveScales(4, 2.0), testing::ElementsAre(1, 2, 4, 8));
  EXPECT_NEAR(OctaveScales(8, 1.2)[7], 3.5831808, 1e-12);
}

TEST(ResizeTest, SameSizeIsTheIdentity) {
  const cv::Mat image = NoiseImage({37, 23}, 1);
  EXPECT_TRUE(SameImage(Resize(image, image.size()), image));
}

TEST(ResizeTest, HalfSizeAveragesFourPixels) {
  const cv::Mat image = (cv::Mat_<std::uint8_t>(2, 4) << 10, 20, 100, 101, 30, 41, 102, 104);
  const cv::Mat half = Resize(image, {2, 1});
  EXPECT_EQ(half.at<std::uint8_t>(0, 0), 25);   // 25.25
  EXPECT_EQ(half.at<std::uint8_t>(0, 1), 102);  // 101.75
}

TEST(ResizeTest, ConstantStaysConstant) {
  for (const int grey : {0, 1, 128, 255}) {
    for (const auto& [from, to] : kResizes) {
      const cv::Mat image(from, CV_8UC1, cv::Scalar(grey));
      EXPECT_TRUE(SameImage(Resize(image, to), cv::Mat(to, CV_8UC1, cv::Scalar(grey))));
    }
  }
}

TEST(ResizeTest, RampIsSampledAtPixelCentres) {
  cv::Mat ramp(60, 120, CV_8UC1);
  for (int y = 0; y < ramp.rows; ++y) {
    for (int x = 0; x < ramp.cols; ++x) {
      ramp.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(x + 2 * y);
    }
  }
  const cv::Mat small = Resize(ramp, {97, 41});
  const PyramidLevel level{small, 120.0 / 97, 60.0 / 41};
  for (int y = 0; y < small.rows; ++y) {
    for (int x = 0; x < small.cols; ++x) {
      const double expected = level.InputX(x) + 2 * level.InputY(y);
      ASSERT_NEAR(small.at<std::uint8_t>(y, x), expected, 0.52) << x << ", " << y;
    }
  }
}

TEST(ResizeTest, CommutesWithMirroringAndQuarterTurns) {
  for (const auto& [from, to] : kResizes) {
    const cv::Mat image = NoiseImage(from, 2);
    const cv::Mat resized = Resize(image, to);
    cv::Mat turned_image, turned;
    for (const int axes : {-1, 0, 1}) {
      cv::flip(image, turned_image, axes);
      cv::flip(resized, turned, axes);
      EXPECT_TRUE(SameImage(Resize(turned_image, to), turned)) << from << " flipped " << axes;
    }
    cv::rotate(image, turned_image, cv::ROTATE_90_CLOCKWISE);
    cv::rotate(resized, turned, cv::ROTATE_90_CLOCKWISE);
    EXPECT_TRUE(SameImage(Resize(turned_image, turned.size()), turned)) << from;
  }
}

TEST(ResizeTest, IsBilinear) {
  const cv::Mat image = ShapesImage({320, 240}, 3);
  cv::Mat expected;
  cv::resize(image, expected, {267, 200}, 0, 0, cv::INTER_LINEAR);
  EXPECT_LE(cv::norm(Resize(image, {267, 200}), expected, cv::NORM_INF), 2);
}

TEST(BuildPyramidTest, LevelSizesAreRoundedAndRatiosAreTrue) {
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

TEST(BuildPyramidTest, FirstLevelIsTheInputAndOthersComeFromTheOneBefore) {
  const cv::Mat image = NoiseImage({100, 80}, 6);
  const auto levels = BuildPyramid(image, OctaveScales(3, 1.5));
  EXPECT_EQ(levels[0].image.data, image.data);
  EXPECT_TRUE(SameImage(levels[2].image, Resize(levels[1].image, {44, 36})));
}

TEST(BuildPyramidTest, LevelsNeverVanish) {
  for (const auto& level : BuildPyramid(NoiseImage({3, 1}, 7), OctaveScales(32, 4.0))) {
    EXPECT_GE(level.image.cols, 1);
    EXPECT_GE(level.image.rows, 1);
  }
}

}  // namespace
}  // namespace corvo::orb
