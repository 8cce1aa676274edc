// SPDX-License-Identifier: MIT
#include "vo/offline/image_pairs.h"

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include <vector>

#include "tests/vo/two_walls.h"
#include "vo/math/median.h"

namespace corvo {
namespace {

constexpr int kNumImages = 10;

/// Returns the pairs among images of 640x480 px of a texture that moves by `step_px` from image to
/// image.
std::vector<PixelMatches> PairsOfMovingTexture(int step_px, double min_displacement = 0.02) {
  const cv::Mat texture = test::MakeTexture(640 + kNumImages * step_px, 480, 7);
  ImagePairOptions options;
  options.max_pairs = 2;
  options.min_displacement = min_displacement;
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

TEST(ImagePairsTest, ImagesOfAStandingCameraAreNoPairEvenIfAnyMotionIsEnough) {
  EXPECT_FALSE(PairsOfMovingTexture(1, 0).empty());
  EXPECT_TRUE(PairsOfMovingTexture(0, 0).empty());
}

}  // namespace
}  // namespace corvo
