// SPDX-License-Identifier: MIT
#include "vo/offline/image_pairs.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <vector>

#include "vo/math/median.h"

namespace corvo {
namespace {

constexpr int kNumImages = 10;

/// Returns the pairs among images of 640x480 px of a texture that moves by `step_px` from image to
/// image.
std::vector<PixelMatches> PairsOfMovingTexture(int step_px) {
  cv::RNG random(7);
  cv::Mat texture(480, 640 + kNumImages * step_px, CV_8UC1);
  random.fill(texture, cv::RNG::UNIFORM, 0, 256);
  cv::GaussianBlur(texture, texture, cv::Size(), 2);
  cv::normalize(texture, texture, 30, 220, cv::NORM_MINMAX);
  ImagePairOptions options;
  options.max_pairs = 2;
  ImagePairs pairs(kNumImages, options);
  for (int i = 0; i < kNumImages; ++i) {
    if (pairs.Needs(i)) pairs.Add(i, texture(cv::Rect(i * step_px, 0, 640, 480)).clone());
  }
  return pairs.Get();
}

TEST(ImagePairsTest, FeaturesHaveMovedFarBetweenTheImagesOfAPair) {
  const std::vector<PixelMatches> pairs = PairsOfMovingTexture(12);
  ASSERT_FALSE(pairs.empty());
  for (const PixelMatches& pair : pairs) {
    ASSERT_GE(pair.size(), 100u);
    std::vector<double> displacements;
    for (const PixelMatch& match : pair) {
      displacements.push_back((match.second - match.first).norm());
    }
    EXPECT_GT(Median(displacements), 0.02 * 800);
  }
}

TEST(ImagePairsTest, ImagesBetweenWhichLittleMovesAreNoPair) {
  EXPECT_TRUE(PairsOfMovingTexture(1).empty());
}

}  // namespace
}  // namespace corvo
