// SPDX-License-Identifier: MIT
#include "orb/fast.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <ostream>

#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>

#include "tests/orb/images.h"
#include "tests/support/data.h"

namespace corvo::orb {

void PrintTo(const Corner& corner, std::ostream* stream) {
  *stream << "(" << corner.x << ", " << corner.y << ") score " << corner.score;
}

namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<Corner> DetectWithOpenCv(const cv::Mat& image, int threshold) {
  std::vector<cv::KeyPoint> keypoints;
  cv::FAST(image, keypoints, threshold, true, cv::FastFeatureDetector::TYPE_9_16);
  std::vector<Corner> corners;
  for (const auto& keypoint : keypoints) {
    corners.push_back({static_cast<int>(keypoint.pt.x), static_cast<int>(keypoint.pt.y),
                       static_cast<int>(keypoint.response)});
  }
  return corners;
}

std::vector<Corner> Keep(std::vector<Corner> corners, const std::function<bool(Corner)>& wanted) {
  std::erase_if(corners, [&](const Corner& corner) { return !wanted(corner); });
  return corners;
}

/// The circle of radius 3, clockwise from the top.
constexpr std::array<std::array<int, 2>, 16> kRing = {{{0, -3},
                                                       {1, -3},
                                                       {2, -2},
                                                       {3, -1},
                                                       {3, 0},
                                                       {3, 1},
                                                       {2, 2},
                                                       {1, 3},
                                                       {0, 3},
                                                       {-1, 3},
                                                       {-2, 2},
                                                       {-3, 1},
                                                       {-3, 0},
                                                       {-3, -1},
                                                       {-2, -2},
                                                       {-1, -3}}};

/// Returns an image of gray level 100 with an arc of the circle about (3, 3) at level `gray`.
cv::Mat ArcImage(int first, int length, int gray) {
  cv::Mat image(7, 7, CV_8UC1, cv::Scalar(100));
  for (int k = first; k < first + length; ++k) {
    image.at<std::uint8_t>(3 + kRing[k % 16][1], 3 + kRing[k % 16][0]) =
        static_cast<std::uint8_t>(gray);
  }
  return image;
}

TEST(DetectFastTest, ArcsOfNineAreCornersInEveryDirection) {
  for (int first = 0; first < 16; ++first) {
    EXPECT_THAT(DetectFast(ArcImage(first, 9, 151), 50), ElementsAre(Corner{3, 3, 50}));
    EXPECT_THAT(DetectFast(ArcImage(first, 9, 49), 50), ElementsAre(Corner{3, 3, 50}));
    EXPECT_THAT(DetectFast(ArcImage(first, 8, 200), 50), IsEmpty());
  }
}

TEST(DetectFastTest, ScoreIsTheLargestThresholdThatStillDetects) {
  const cv::Mat image = ArcImage(5, 11, 163);
  EXPECT_THAT(DetectFast(image, 1), ElementsAre(Corner{3, 3, 62}));
  EXPECT_THAT(DetectFast(image, 62), ElementsAre(Corner{3, 3, 62}));
  EXPECT_THAT(DetectFast(image, 63), IsEmpty());
}

TEST(DetectFastTest, FullContrastIsFoundAtTheHighestThreshold) {
  cv::Mat image(7, 7, CV_8UC1, cv::Scalar(255));
  image.at<std::uint8_t>(3, 3) = 0;
  EXPECT_THAT(DetectFast(image, 254), ElementsAre(Corner{3, 3, 254}));
}

TEST(DetectFastTest, EqualNeighborsSuppressOneAnother) {
  cv::Mat image(9, 10, CV_8UC1, cv::Scalar(0));
  image.at<std::uint8_t>(4, 4) = 200;
  EXPECT_EQ(DetectFast(image, 20).size(), 1U);
  image.at<std::uint8_t>(4, 5) = 200;
  EXPECT_THAT(DetectFast(image, 20), IsEmpty());
}

TEST(DetectFastTest, EqualsOpenCvOnDrawnAndRandomImages) {
  for (const int threshold : {1, 7, 20, 60, 150, 254}) {
    for (std::uint64_t seed = 0; seed < 3; ++seed) {
      const cv::Mat noise = test::NoiseImage({211, 97}, seed);
      EXPECT_EQ(DetectFast(noise, threshold), DetectWithOpenCv(noise, threshold)) << threshold;
      const cv::Mat shapes = test::ShapesImage({211, 97}, seed);
      EXPECT_EQ(DetectFast(shapes, threshold), DetectWithOpenCv(shapes, threshold)) << threshold;
    }
  }
}

TEST(DetectFastTest, EqualsOpenCvAtEveryWidth) {
  for (int width = 7; width < 110; ++width) {
    const cv::Mat image = test::NoiseImage({width, 12}, 5);
    EXPECT_EQ(DetectFast(image, 10), DetectWithOpenCv(image, 10)) << "width " << width;
  }
}

TEST(DetectFastTest, EqualsOpenCvOnRealImages) {
  CORVO_REQUIRE_DATA("oxford_affine");
  for (const auto& path : test::RealImages()) {
    const cv::Mat image = test::ReadGray(path);
    for (const int threshold : {3, 7, 20, 50}) {
      EXPECT_EQ(DetectFast(image, threshold), DetectWithOpenCv(image, threshold)) << path;
    }
  }
}

TEST(DetectFastTest, HigherThresholdKeepsCornersOfAtLeastThatScore) {
  const cv::Mat image = test::ShapesImage({300, 200}, 9);
  const auto at_least_20 =
      Keep(DetectFast(image, 7), [](const Corner& c) { return c.score >= 20; });
  ASSERT_GT(at_least_20.size(), 100U);
  EXPECT_EQ(DetectFast(image, 20), at_least_20);
}

TEST(DetectFastTest, RegionOnlyFiltersTheResult) {
  const cv::Mat image = test::NoiseImage({150, 90}, 10);
  for (const cv::Rect region : {cv::Rect(21, 21, 108, 48), cv::Rect(0, 0, 150, 90),
                                cv::Rect(-5, 40, 30, 100), cv::Rect(70, 30, 1, 1)}) {
    const auto inside = Keep(DetectFast(image, 7),
                             [&](const Corner& c) { return region.contains(cv::Point(c.x, c.y)); });
    EXPECT_EQ(DetectFast(image, 7, region), inside) << region;
  }
}

TEST(DetectFastTest, SubmatrixGivesTheSameResultAsItsCopy) {
  const cv::Mat view = test::NoiseImage({200, 100}, 11)(cv::Rect(13, 9, 111, 60));
  EXPECT_EQ(DetectFast(view, 7), DetectFast(view.clone(), 7));
}

TEST(DetectFastTest, TinyImagesHaveNoCorners) {
  for (const cv::Size size : {cv::Size(1, 1), cv::Size(6, 40), cv::Size(40, 6), cv::Size(3, 3)}) {
    EXPECT_THAT(DetectFast(test::NoiseImage(size, 12), 1), IsEmpty());
  }
}

}  // namespace
}  // namespace corvo::orb
