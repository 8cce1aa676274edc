// SPDX-License-Identifier: MIT
#include "vo/tracking/repeat_detector.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <string>
#include <vector>

#include "tests/vo/tracking/moved_texture.h"

namespace corvo {
namespace {

using test::MakeSmoothTexture;
using test::Shift;

cv::Mat Zoom(const cv::Mat& image, double factor) { return test::TurnAndZoom(image, 0, factor); }

cv::Mat AddNoise(const cv::Mat& image, double sigma) {
  cv::RNG random(8);
  cv::Mat noise(image.size(), CV_16SC1), noisy;
  random.fill(noise, cv::RNG::NORMAL, 0, sigma);
  cv::add(image, noise, noisy, cv::noArray(), CV_8U);
  return noisy;
}

/// Quantizes the cosine transform of blocks of 8x8 px, like JPEG and most video codecs.
cv::Mat Compress(const cv::Mat& image, double step) {
  cv::Mat values;
  image.convertTo(values, CV_32F);
  for (int y = 0; y + 8 <= image.rows; y += 8) {
    for (int x = 0; x + 8 <= image.cols; x += 8) {
      cv::Mat block = values(cv::Rect(x, y, 8, 8));
      cv::dct(block, block);
      for (auto value = block.begin<float>(); value != block.end<float>(); ++value) {
        *value = static_cast<float>(step * std::round(*value / step));
      }
      cv::idct(block, block);
    }
  }
  cv::Mat compressed;
  values.convertTo(compressed, CV_8U);
  return compressed;
}

bool Repeats(const cv::Mat& first, const cv::Mat& second) {
  RepeatDetector detector;
  EXPECT_FALSE(detector.Add(ReducedImage(first)));
  return detector.Add(ReducedImage(second));
}

class RepeatDetectorTest : public testing::TestWithParam<cv::Size> {
 protected:
  cv::Mat image_ = MakeSmoothTexture(GetParam().width, GetParam().height);
};

TEST_P(RepeatDetectorTest, EqualImagesRepeat) { EXPECT_TRUE(Repeats(image_, image_.clone())); }

TEST_P(RepeatDetectorTest, NoiseBrightnessAndCompressionAreNotMotion) {
  EXPECT_TRUE(Repeats(image_, AddNoise(image_, 2)));
  EXPECT_TRUE(Repeats(image_, image_ + cv::Scalar(5)));
  EXPECT_TRUE(Repeats(Compress(image_, 10), Compress(image_, 16)));
}

TEST_P(RepeatDetectorTest, AShiftOfHalfAPixelIsMotion) {
  EXPECT_FALSE(Repeats(image_, Shift(image_, 0.5, 0)));
  EXPECT_FALSE(Repeats(image_, Shift(image_, 0, -0.5)));
  EXPECT_FALSE(Repeats(image_, Shift(image_, 20, 3)));
}

TEST_P(RepeatDetectorTest, SlowForwardMotionIsMotion) {
  EXPECT_FALSE(Repeats(image_, Zoom(image_, 1 + 1.0 / image_.cols)));
}

/// Cells move by less than the noise of a single cell; only their motion together tells.
TEST(RepeatDetectorOfASquareImageTest, AFaintZoomOrTurnIsMotion) {
  const cv::Mat image = MakeSmoothTexture(480, 480);
  EXPECT_FALSE(Repeats(image, Zoom(image, 1 + 0.35 / image.cols)));
  const double degrees = 0.35 / image.cols * 180 / CV_PI;
  EXPECT_FALSE(Repeats(image, test::TurnAndZoom(image, degrees, 1)));
}

TEST_P(RepeatDetectorTest, SlowMotionAddsUp) {
  RepeatDetector detector;
  int num_distinct = 0;
  for (int i = 0; i < 30; ++i)
    num_distinct += !detector.Add(ReducedImage(Shift(image_, 0.05 * i, 0)));
  EXPECT_GT(num_distinct, 5);
}

TEST_P(RepeatDetectorTest, AStandingCameraRepeatsThoughSomethingMovesInItsView) {
  cv::Mat second = image_.clone();
  const cv::Rect mover(0, 0, image_.cols / 4, image_.rows / 2);
  Shift(image_, 9, 0)(mover).copyTo(second(mover));
  EXPECT_TRUE(Repeats(image_, second));
}

INSTANTIATE_TEST_SUITE_P(Sizes, RepeatDetectorTest,
                         testing::Values(cv::Size(320, 240), cv::Size(640, 480),
                                         cv::Size(1241, 376), cv::Size(1920, 1080)),
                         [](const auto& param_info) {
                           return "Width" + std::to_string(param_info.param.width);
                         });

/// Returns a gray image of 32 x 24 cells of which `num_cells` show texture.
cv::Mat MakeImageWithTexturedCells(int num_cells) {
  constexpr int kSize = CellDisplacement::kCellSize;
  const cv::Mat texture = MakeSmoothTexture(320, 240);
  cv::Mat image(240, 320, CV_8UC1, cv::Scalar(100));
  for (int i = 0; i < num_cells; ++i) {
    const cv::Rect inner(i % 8 * 4 * kSize + 1, i / 8 * 4 * kSize + 1, kSize - 2, kSize - 2);
    texture(inner).copyTo(image(inner));
  }
  int num_textured = 0;
  const ReducedImage reduced(image);
  for (const CellMotion& cell : CellDisplacement(reduced).Measure(reduced)) {
    num_textured += cell.is_textured;
  }
  EXPECT_EQ(num_textured, num_cells);
  return image;
}

TEST(RepeatDetectorBlankTest, ImagesWithTextureInFewerThanTwentyCellsRepeatOnlyIfTheyAreEqual) {
  const cv::Mat twenty = MakeImageWithTexturedCells(20), fewer = MakeImageWithTexturedCells(19);
  EXPECT_TRUE(Repeats(twenty, twenty + cv::Scalar(1)));
  EXPECT_FALSE(Repeats(fewer, fewer + cv::Scalar(1)));
  EXPECT_TRUE(Repeats(fewer, fewer));
}

TEST(RepeatDetectorBlankTest, BlankImagesRepeatOnlyIfTheyAreEqual) {
  const cv::Mat dark(480, 640, CV_8UC1, cv::Scalar(10)),
      brighter(480, 640, CV_8UC1, cv::Scalar(11));
  EXPECT_TRUE(Repeats(dark, dark));
  EXPECT_FALSE(Repeats(dark, brighter));
}

}  // namespace
}  // namespace corvo
