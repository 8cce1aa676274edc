// SPDX-License-Identifier: MIT
#include "orb/level_detail.h"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "orb/extractor.h"
#include "orb/workers.h"

namespace corvo::orb {
namespace {

/// Texture with edges at all scales: rectangles of random size and brightness.
cv::Mat MakeSharpImage(int width, int height) {
  cv::RNG random(3);
  cv::Mat image(height, width, CV_8UC1, cv::Scalar(128));
  for (int i = 0; i < 3000; ++i) {
    const int side = 2 + static_cast<int>(120 / (1 + random.uniform(0., 40.)));
    const int x = random.uniform(0, width);  // The order of arguments' evaluation is not fixed.
    const int y = random.uniform(0, height);
    const cv::Rect rectangle(x, y, side, side);
    cv::rectangle(image, rectangle, random.uniform(20, 235), cv::FILLED);
  }
  return image;
}

cv::Mat Enlarge(const cv::Mat& image, double factor) {
  cv::Mat enlarged;
  cv::resize(image, enlarged, cv::Size(), factor, factor, cv::INTER_CUBIC);
  return enlarged;
}

int FirstLevelOf(const cv::Mat& image, double min_detail = ExtractorOptions().min_detail) {
  Workers workers(1);
  Pyramid pyramid(OctaveScales(14, 1.2));
  pyramid.Build(image, workers);
  return FindFirstDetailedLevel(pyramid.levels(), min_detail);
}

TEST(LevelDetail, SharpImagesUseEveryLevel) {
  EXPECT_EQ(FirstLevelOf(MakeSharpImage(640, 480)), 0);
}

TEST(LevelDetail, EnlargedAndBlurredImagesSkipTheFinestLevels) {
  const cv::Mat image = MakeSharpImage(320, 240);
  EXPECT_GE(FirstLevelOf(Enlarge(image, 4)), 1);
  cv::Mat blurred;
  cv::GaussianBlur(MakeSharpImage(640, 480), blurred, cv::Size(), 3);
  EXPECT_GE(FirstLevelOf(blurred), 1);
}

TEST(LevelDetail, BlankImagesAndAMinimumOfZeroUseEveryLevel) {
  EXPECT_EQ(FirstLevelOf(cv::Mat(480, 640, CV_8UC1, cv::Scalar(90))), 0);
  EXPECT_EQ(FirstLevelOf(Enlarge(MakeSharpImage(320, 240), 4), 0), 0);
}

TEST(LevelDetail, TheExtractorFindsTheWantedNumberInTheLevelsLeft) {
  ExtractorOptions options;
  options.num_features = 500;
  const Features features = Extractor(options).Extract(Enlarge(MakeSharpImage(320, 240), 4));
  EXPECT_EQ(features.keypoints.size(), 500u);
  for (const Keypoint& keypoint : features.keypoints) EXPECT_GE(keypoint.octave, 1);
}

}  // namespace
}  // namespace corvo::orb
