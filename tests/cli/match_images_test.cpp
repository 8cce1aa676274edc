// SPDX-License-Identifier: MIT
#include "apps/output/match_images.h"

#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "tests/cli/tiny_sequence.h"

namespace corvo {
namespace {

using test::TinyImage;

/// A rotation by 10 degrees with slight perspective.
const cv::Matx33d kSecondFromFirst(0.985, -0.174, 25, 0.174, 0.985, -20, 1e-4, 0, 1);

struct Pair {
  orb::Features first, second;
};

Pair ExtractPair() {
  const cv::Mat first = TinyImage(3, 320, 240);
  cv::Mat smooth, second;
  cv::GaussianBlur(first, smooth, {0, 0}, 1.5);
  cv::warpPerspective(smooth, second, kSecondFromFirst, smooth.size());
  const orb::Extractor extractor;
  return {extractor.Extract(smooth), extractor.Extract(second)};
}

TEST(MatchImagesTest, FindsTheHomographyAndItsInliers) {
  const Pair pair = ExtractPair();
  const ImageMatches images = MatchImages(pair.first, pair.second, 80, 0.8);
  ASSERT_TRUE(images.second_from_first);
  ASSERT_GE(images.num_inliers, 100);
  ASSERT_EQ(images.is_inlier.size(), images.matches.size());
  int inliers = 0;
  for (std::size_t i = 0; i < images.matches.size(); ++i) {
    if (images.is_inlier[i] == 0) continue;
    const orb::Keypoint& from = images.first.keypoints[images.matches[i].query];
    const orb::Keypoint& to = images.second.keypoints[images.matches[i].train];
    const cv::Vec3d expected = kSecondFromFirst * cv::Vec3d(from.x, from.y, 1);
    EXPECT_LE(std::hypot(expected[0] / expected[2] - to.x, expected[1] / expected[2] - to.y), 5);
    ++inliers;
  }
  EXPECT_EQ(images.num_inliers, inliers);
}

TEST(MatchImagesTest, MatchesAreMutualAndPassBothLimits) {
  const Pair pair = ExtractPair();
  const auto second_to_first = orb::FindNearest(pair.second.descriptors, pair.first.descriptors);
  const auto first_to_second = orb::FindNearest(pair.first.descriptors, pair.second.descriptors);
  const auto matches = MatchImages(pair.first, pair.second, 30, 0.7).matches;
  ASSERT_FALSE(matches.empty());
  for (const orb::Match& match : matches) {
    EXPECT_EQ(second_to_first[match.train].index, match.query);
    EXPECT_EQ(first_to_second[match.query].index, match.train);
    EXPECT_LE(match.distance, 30);
    EXPECT_LT(match.distance, 0.7 * first_to_second[match.query].second_distance);
  }
}

TEST(MatchImagesTest, FewerThanFourMatchesHaveNoHomography) {
  Pair pair = ExtractPair();
  pair.first.keypoints.resize(3);
  pair.first.descriptors.resize(3);
  const ImageMatches images = MatchImages(pair.first, pair.second, 256, 1.0);
  EXPECT_LE(images.matches.size(), 3U);
  EXPECT_FALSE(images.second_from_first);
  EXPECT_EQ(images.num_inliers, 0);
  EXPECT_EQ(images.is_inlier.size(), images.matches.size());
}

}  // namespace
}  // namespace corvo
