// SPDX-License-Identifier: MIT
#include "orb/extractor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <tuple>

#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>

#include "orb/descriptor.h"
#include "orb/hamming.h"
#include "orb/harris.h"
#include "orb/learned_pattern.h"
#include "orb/matcher.h"
#include "orb/pyramid.h"
#include "orb/window_sums.h"
#include "tests/orb/images.h"
#include "tests/support/data.h"
#include "tests/support/matchers.h"

namespace corvo::orb {
namespace {

using test::NoiseImage;
using test::ReadGray;
using test::ShapesImage;
using test::ThrowsError;

constexpr int kAll = 100000;

ExtractorOptions WithFeatures(int num_features) {
  ExtractorOptions options;
  options.num_features = num_features;
  return options;
}

/// The level coordinates of a keypoint, rounded, and their distance from integers.
struct LevelPixel {
  int x, y;
  double error;
};

LevelPixel ToLevel(const Keypoint& keypoint, const PyramidLevel& level) {
  const double x = (keypoint.x + 0.5) / level.ratio_x - 0.5;
  const double y = (keypoint.y + 0.5) / level.ratio_y - 0.5;
  const double error = std::max(std::abs(x - std::round(x)), std::abs(y - std::round(y)));
  return {static_cast<int>(std::round(x)), static_cast<int>(std::round(y)), error};
}

/// Counts with cv::FAST the corners of all levels inside the border and the mask.
int CountCorners(const cv::Mat& image, const cv::Mat& mask = cv::Mat()) {
  int count = 0;
  for (const auto& level : BuildPyramid(image, OctaveScales(8, 1.2))) {
    std::vector<cv::KeyPoint> corners;
    cv::FAST(level.image, corners, 7, true);
    for (const auto& corner : corners) {
      const bool inside = corner.pt.x >= 21 && corner.pt.x <= level.image.cols - 22 &&
                          corner.pt.y >= 21 && corner.pt.y <= level.image.rows - 22;
      const auto column = static_cast<int>(std::lround(level.InputX(corner.pt.x)));
      const auto row = static_cast<int>(std::lround(level.InputY(corner.pt.y)));
      count += inside && (mask.empty() || mask.at<std::uint8_t>(row, column) != 0);
    }
  }
  return count;
}

/// Returns a mask with the given value inside a disc and 0 elsewhere.
cv::Mat DiscMask(cv::Size size, int value) {
  cv::Mat mask(size, CV_8UC1, cv::Scalar(0));
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const int dx = x - size.width / 2, dy = y - size.height / 2;
      if (dx * dx + dy * dy < size.height * size.height / 9) {
        mask.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(value);
      }
    }
  }
  return mask;
}

/// Checks the number of features for requests below, at and above the number of corners.
void ExpectExactlyTheWantedNumber(const cv::Mat& image, const cv::Mat& mask,
                                  std::vector<int> numbers) {
  const int available = CountCorners(image, mask);
  numbers.insert(numbers.end(), {available - 1, available, available + 1});
  for (const int wanted : numbers) {
    for (const bool grid : {true, false}) {
      ExtractorOptions options = WithFeatures(wanted);
      options.grid = grid;
      const Features features = Extractor(options).Extract(image, mask);
      EXPECT_EQ(features.keypoints.size(), std::min(wanted, available)) << "grid " << grid;
      EXPECT_EQ(features.descriptors.size(), features.keypoints.size());
    }
  }
}

TEST(ExtractorTest, ReturnsTheRequestedNumberOrAllCorners) {
  const std::vector<int> numbers = {1, 2, 7, 100, 333, 1000};
  const cv::Mat mask = DiscMask({320, 240}, 1);
  ExpectExactlyTheWantedNumber(NoiseImage({200, 150}, 1), cv::Mat(), numbers);
  ExpectExactlyTheWantedNumber(ShapesImage({320, 240}, 2), cv::Mat(), numbers);
  ExpectExactlyTheWantedNumber(ShapesImage({320, 240}, 3), mask, numbers);
  ExpectExactlyTheWantedNumber(ShapesImage({320, 240}, 4, 100, 115), cv::Mat(), numbers);
}

TEST(ExtractorTest, ReturnsTheRequestedNumberOrAllCornersOnRealImages) {
  CORVO_REQUIRE_DATA("oxford_affine");
  for (const auto& path : test::RealImages()) {
    const cv::Mat image = ReadGray(path);
    const cv::Mat part = image(cv::Rect(0, 0, 400, 300) & cv::Rect({}, image.size()));
    ExpectExactlyTheWantedNumber(part, cv::Mat(), {500, 2000});
    ExpectExactlyTheWantedNumber(part, DiscMask(part.size(), 1), {200});
  }
}

TEST(ExtractorTest, DefaultNumberOfFeaturesDependsOnTheLongerSideOnly) {
  EXPECT_EQ(Extractor().Extract(NoiseImage({899, 200}, 5)).keypoints.size(), 1000U);
  EXPECT_EQ(Extractor().Extract(NoiseImage({900, 200}, 5)).keypoints.size(), 2000U);
  EXPECT_EQ(Extractor().Extract(NoiseImage({200, 900}, 5)).keypoints.size(), 2000U);
}

TEST(ExtractorTest, KeypointsAreCornersInsideTheBorderSortedAndDistinct) {
  const cv::Mat image = ShapesImage({400, 300}, 6);
  const auto levels = BuildPyramid(image, OctaveScales(8, 1.2));
  std::set<int> octaves;
  std::tuple<int, int, int> before{-1, 0, 0};
  for (const auto& keypoint : Extractor().Extract(image).keypoints) {
    const PyramidLevel& level = levels.at(keypoint.octave);
    const LevelPixel pixel = ToLevel(keypoint, level);
    EXPECT_LT(pixel.error, 1e-4);
    EXPECT_GE(pixel.x, kBorder);
    EXPECT_GE(pixel.y, kBorder);
    EXPECT_LT(pixel.x, level.image.cols - kBorder);
    EXPECT_LT(pixel.y, level.image.rows - kBorder);
    EXPECT_GE(keypoint.angle_deg, 0);
    EXPECT_LT(keypoint.angle_deg, 360);
    const std::tuple<int, int, int> place{keypoint.octave, pixel.y, pixel.x};
    EXPECT_LT(before, place);
    before = place;
    octaves.insert(keypoint.octave);
  }
  EXPECT_EQ(octaves.size(), 8U);
}

TEST(ExtractorTest, PatchesAreThePixelsAroundKeypoints) {
  const cv::Mat image = ShapesImage({400, 300}, 6);
  const auto levels = BuildPyramid(image, OctaveScales(8, 1.2));
  Features features;
  std::vector<Patch> patches;
  Extractor().Extract(image, cv::Mat(), features, patches);
  EXPECT_EQ(features, Extractor().Extract(image));
  ASSERT_EQ(patches.size(), features.keypoints.size());
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const PyramidLevel& level = levels.at(features.keypoints[i].octave);
    const LevelPixel pixel = ToLevel(features.keypoints[i], level);
    for (int row = -Patch::kRadius; row <= Patch::kRadius; ++row) {
      for (int column = -Patch::kRadius; column <= Patch::kRadius; ++column) {
        const int index = (row + Patch::kRadius) * Patch::kSide + column + Patch::kRadius;
        ASSERT_EQ(patches[i].pixels[index],
                  level.image.at<std::uint8_t>(pixel.y + row, pixel.x + column));
      }
    }
  }
}

TEST(ExtractorTest, GridQuotasAreProportionalToTheLevelArea) {
  std::vector<int> counts(8, 0);
  const Features features = Extractor(WithFeatures(1000)).Extract(NoiseImage({640, 480}, 7));
  for (const auto& keypoint : features.keypoints) ++counts[keypoint.octave];
  double total = 0;
  std::vector<double> areas;
  for (const auto& level : BuildPyramid(NoiseImage({640, 480}, 7), OctaveScales(8, 1.2))) {
    areas.push_back((level.image.cols - 42.0) * (level.image.rows - 42.0));
    total += areas.back();
  }
  for (int i = 0; i < 8; ++i) EXPECT_NEAR(counts[i], 1000 * areas[i] / total, 1) << "level " << i;
}

TEST(ExtractorTest, WithoutAGridQuotasAreProportionalToTheRootOfTheLevelSide) {
  ExtractorOptions options;
  options.grid = false;
  const Features features = Extractor(options).Extract(NoiseImage({640, 480}, 7));
  std::vector<int> counts(8, 0);
  for (const auto& keypoint : features.keypoints) ++counts[keypoint.octave];
  double total = 0;
  std::vector<double> roots;
  for (const auto& level : BuildPyramid(NoiseImage({640, 480}, 7), OctaveScales(8, 1.2))) {
    roots.push_back(std::pow((level.image.cols - 42.0) * (level.image.rows - 42.0), 0.25));
    total += roots.back();
  }
  for (int i = 0; i < 8; ++i) EXPECT_NEAR(counts[i], 1000 * roots[i] / total, 1) << "level " << i;
}

TEST(ExtractorTest, WithoutAGridHarrisRanksTwiceAsManyFastCorners) {
  ExtractorOptions options;
  options.grid = false;
  options.num_levels = 1;
  options.num_features = 400;
  options.fast_threshold = options.min_fast_threshold;
  const cv::Mat image = ShapesImage({640, 480}, 13);
  const Features sharp = Extractor(options).Extract(image);
  options.num_features = 200;
  options.ranking = Ranking::kHarris;
  const Features chosen = Extractor(options).Extract(image);
  ASSERT_EQ(sharp.keypoints.size(), 400U);
  ASSERT_EQ(chosen.keypoints.size(), 200U);
  std::vector<float> responses;
  for (const auto& keypoint : sharp.keypoints) {
    responses.push_back(static_cast<float>(
        HarrisResponse(image, static_cast<int>(keypoint.x), static_cast<int>(keypoint.y))));
  }
  std::nth_element(responses.begin(), responses.begin() + 199, responses.end(), std::greater<>());
  for (const auto& keypoint : chosen.keypoints) EXPECT_GE(keypoint.response, responses[199]);
}

TEST(ExtractorTest, AnyNonZeroMaskValueKeepsKeypoints) {
  const cv::Mat image = ShapesImage({320, 240}, 8);
  const Features kept = Extractor().Extract(image, DiscMask(image.size(), 255));
  ASSERT_GT(kept.keypoints.size(), 100U);
  EXPECT_EQ(Extractor().Extract(image, DiscMask(image.size(), 1)), kept);
  const cv::Mat all(image.size(), CV_8UC1, cv::Scalar(1));
  EXPECT_EQ(Extractor().Extract(image, all), Extractor().Extract(image));
}

TEST(ExtractorTest, NoKeypointLiesOutsideTheMask) {
  const cv::Mat image = NoiseImage({320, 240}, 9);
  const cv::Mat mask = DiscMask(image.size(), 1);
  for (const auto& keypoint : Extractor().Extract(image, mask).keypoints) {
    const auto x = static_cast<int>(std::lround(keypoint.x));
    EXPECT_NE(mask.at<std::uint8_t>(static_cast<int>(std::lround(keypoint.y)), x), 0);
  }
  const cv::Mat none(image.size(), CV_8UC1, cv::Scalar(0));
  EXPECT_TRUE(Extractor().Extract(image, none).keypoints.empty());
}

TEST(ExtractorTest, ResultDoesNotDependOnTheNumberOfThreads) {
  for (const Ranking ranking : {Ranking::kFast, Ranking::kHarris}) {
    ExtractorOptions options;
    options.ranking = ranking;
    const cv::Mat image = ShapesImage({640, 480}, 10);
    const Features expected = Extractor(options, 1).Extract(image);
    ASSERT_EQ(expected.keypoints.size(), 1000U);
    for (const int threads : {1, 2, 3}) {
      const Extractor extractor(options, threads);
      EXPECT_EQ(extractor.Extract(image), expected);
      EXPECT_EQ(extractor.Extract(image), expected);
    }
  }
}

TEST(ExtractorTest, SubmatrixGivesTheSameResultAsItsCopy) {
  const cv::Mat view = ShapesImage({400, 300}, 11)(cv::Rect(17, 9, 301, 222));
  EXPECT_EQ(Extractor().Extract(view), Extractor().Extract(view.clone()));
}

TEST(ExtractorTest, BrightnessOffsetChangesNothing) {
  const cv::Mat image = ShapesImage({320, 240}, 12, 0, 200);
  EXPECT_EQ(Extractor().Extract(image + cv::Scalar(55)), Extractor().Extract(image));
}

/// Returns the index in `features` of the keypoint of `octave` at (x, y), or -1.
int FindKeypoint(const Features& features, int octave, double x, double y) {
  for (int i = 0; i < static_cast<int>(features.keypoints.size()); ++i) {
    const Keypoint& keypoint = features.keypoints[i];
    if (keypoint.octave != octave) continue;
    if (std::abs(keypoint.x - x) < 1e-3 && std::abs(keypoint.y - y) < 1e-3) return i;
  }
  return -1;
}

TEST(ExtractorTest, QuarterTurnOfTheImageRotatesEveryFeature) {
  ExtractorOptions options = WithFeatures(kAll);
  options.orientation_bins = 36;
  const cv::Mat image = ShapesImage({240, 181}, 13);
  cv::Mat turned_image;
  cv::rotate(image, turned_image, cv::ROTATE_90_CLOCKWISE);
  const Features features = Extractor(options).Extract(image);
  const Features turned = Extractor(options).Extract(turned_image);
  ASSERT_GT(features.keypoints.size(), 500U);
  ASSERT_EQ(turned.keypoints.size(), features.keypoints.size());
  for (std::size_t i = 0; i < features.keypoints.size(); ++i) {
    const Keypoint& keypoint = features.keypoints[i];
    const int j = FindKeypoint(turned, keypoint.octave, 180 - keypoint.y, keypoint.x);
    ASSERT_GE(j, 0);
    EXPECT_EQ(turned.keypoints[j].response, keypoint.response);
    EXPECT_EQ(turned.descriptors[j], features.descriptors[i]);
    const double change = turned.keypoints[j].angle_deg - keypoint.angle_deg - 90.0;
    EXPECT_LT(std::abs(std::remainder(change, 360)), 1e-3);
  }
}

Features OfOctave(const Features& features, int octave) {
  Features part;
  for (std::size_t i = 0; i < features.keypoints.size(); ++i) {
    if (features.keypoints[i].octave != octave) continue;
    part.keypoints.push_back(features.keypoints[i]);
    part.descriptors.push_back(features.descriptors[i]);
  }
  return part;
}

std::vector<Match> MatchMutually(const Features& query, const Features& train) {
  const auto matches = DistanceTest(FindNearest(query.descriptors, train.descriptors), 256);
  return CrossCheck(matches, FindNearest(train.descriptors, query.descriptors));
}

/// Returns the bias of the coordinates: half the median distance between keypoints and their
/// matches in the image rotated by 180 degrees, rotated back.
double HalfTurnBias(const Features& features, const Features& turned, cv::Size size) {
  std::vector<double> residuals;
  for (const Match& match : MatchMutually(features, turned)) {
    const Keypoint& a = features.keypoints[match.query];
    const Keypoint& b = turned.keypoints[match.train];
    residuals.push_back(std::hypot(a.x + b.x - (size.width - 1), a.y + b.y - (size.height - 1)));
  }
  if (residuals.empty()) return 1e9;
  std::nth_element(residuals.begin(), residuals.begin() + residuals.size() / 2, residuals.end());
  return residuals[residuals.size() / 2] / 2;
}

TEST(ExtractorTest, CoordinatesHaveNoBiasAtAnyOctave) {
  CORVO_REQUIRE_DATA("oxford_affine");
  for (const auto& path : test::RealImages()) {
    const cv::Mat image = ReadGray(path);
    cv::Mat turned_image;
    cv::rotate(image, turned_image, cv::ROTATE_180);
    const Features features = Extractor().Extract(image);
    const Features turned = Extractor().Extract(turned_image);
    for (int octave = 0; octave < 8; ++octave) {
      const double bias =
          HalfTurnBias(OfOctave(features, octave), OfOctave(turned, octave), image.size());
      EXPECT_LE(bias, 0.1) << path << ", octave " << octave;
    }
  }
}

TEST(ExtractorTest, GridSpreadsKeypointsOverWeakTexture) {
  cv::Mat image = ShapesImage({640, 480}, 14, 0, 255);
  ShapesImage({320, 480}, 15, 105, 140).copyTo(image(cv::Rect(0, 0, 320, 480)));
  const auto count_left = [&](bool grid) {
    ExtractorOptions options = WithFeatures(1000);
    options.grid = grid;
    const Features features = Extractor(options).Extract(image);
    return std::count_if(features.keypoints.begin(), features.keypoints.end(),
                         [](const Keypoint& k) { return k.x < 310; });
  };
  EXPECT_EQ(count_left(false), 0);
  EXPECT_GT(count_left(true), 300);
}

TEST(ExtractorTest, UprightUsesTheUnrotatedPattern) {
  const cv::Mat image = ShapesImage({200, 160}, 16);
  ExtractorOptions options;
  options.num_levels = 1;
  options.upright = true;
  const Features upright = Extractor(options).Extract(image);
  ASSERT_FALSE(upright.keypoints.empty());
  const Describer describer(LearnedPattern(), 30, true);
  const cv::Mat sums = WindowSums(image);
  for (std::size_t i = 0; i < upright.keypoints.size(); ++i) {
    const auto x = static_cast<int>(upright.keypoints[i].x);
    const auto y = static_cast<int>(upright.keypoints[i].y);
    EXPECT_EQ(upright.descriptors[i],
              describer.Describe(sums.ptr<std::uint16_t>(y) + x, sums.cols, 123));
  }
  options.upright = false;
  EXPECT_EQ(Extractor(options).Extract(image).keypoints, upright.keypoints);
}

TEST(ExtractorTest, DescribeReproducesExtractForItsKeypoints) {
  const cv::Mat image = ShapesImage({400, 300}, 30);
  for (const bool upright : {false, true}) {
    ExtractorOptions options;
    options.upright = upright;
    const Extractor extractor(options);
    const Features features = extractor.Extract(image);
    ASSERT_EQ(features.keypoints.size(), 1000U);
    const DescribedKeypoints described = extractor.Describe(image, features.keypoints);
    EXPECT_EQ(described.features, features);
    ASSERT_EQ(described.indices.size(), 1000U);
    for (int i = 0; i < 1000; ++i) EXPECT_EQ(described.indices[i], i);
  }
}

TEST(ExtractorTest, DescribeUsesTheGivenAngleAndComputesAMissingOne) {
  const cv::Mat image = ShapesImage({300, 200}, 31);
  const Extractor extractor;
  const Features features = extractor.Extract(image);
  for (const float none : {-1.0F, 360.0F, std::nanf("")}) {
    std::vector<Keypoint> keypoints = features.keypoints;
    for (Keypoint& keypoint : keypoints) keypoint.angle_deg = none;
    EXPECT_EQ(extractor.Describe(image, keypoints).features, features);
  }
  Keypoint turned = features.keypoints[0];
  turned.angle_deg = turned.angle_deg < 180 ? turned.angle_deg + 180 : turned.angle_deg - 180;
  const Features described = extractor.Describe(image, std::vector{turned}).features;
  EXPECT_EQ(described.keypoints[0], turned);
  EXPECT_GT(HammingDistance(described.descriptors[0], features.descriptors[0]), 40);
}

TEST(ExtractorTest, DescribeSkipsInvalidKeypointsAndThoseNearTheBorder) {
  const cv::Mat image = ShapesImage({120, 100}, 32);
  const float nan = std::nanf("");
  const std::vector<Keypoint> keypoints = {
      {20.4F, 50, 0, 1, 0}, {20.5F, 50, 0, 2, 0}, {50, 79, 0, 3, 0},  {50, 78, 0, 4, 0},
      {60, 50, 0, 5, -1},   {60, 50, 0, 6, 8},    {60, 50, 0, 7, 7},  {60, 50, 0, 8, 3},
      {nan, 50, 0, 9, 0},   {60, -1e30F, 0, 10},  {1e30F, 50, 0, 11}, {25, 50, 0, 12, 2}};
  const DescribedKeypoints described = Extractor().Describe(image, keypoints);
  EXPECT_THAT(described.indices, testing::ElementsAre(1, 3, 7));
  ASSERT_EQ(described.features.descriptors.size(), 3U);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(described.features.keypoints[i], keypoints[described.indices[i]]);
  }
  EXPECT_TRUE(Extractor().Describe(image, {}).indices.empty());
  EXPECT_THAT([&] { Extractor().Describe(cv::Mat(), keypoints); }, ThrowsError("image is empty"));
}

TEST(ExtractorTest, OctaveScalesArePowersOfTheScaleFactor) {
  ExtractorOptions options;
  options.num_levels = 3;
  options.scale_factor = 1.5;
  EXPECT_THAT(Extractor(options).octave_scales(), testing::ElementsAre(1, 1.5, 2.25));
}

TEST(ExtractorTest, BlankAndTinyImagesHaveNoKeypoints) {
  const cv::Mat blank(240, 320, CV_8UC1, cv::Scalar(128));
  EXPECT_EQ(Extractor().Extract(blank), Features{});
  for (const cv::Size size :
       {cv::Size(1, 1), cv::Size(40, 40), cv::Size(42, 42), cv::Size(500, 5)}) {
    EXPECT_EQ(Extractor({}, 2).Extract(NoiseImage(size, 17)), Features{});
  }
}

TEST(ExtractorTest, SmallestPossibleImageHasOneKeypoint) {
  cv::Mat image(43, 43, CV_8UC1, cv::Scalar(0));
  image.at<std::uint8_t>(21, 21) = 255;
  const Features features = Extractor().Extract(image);
  ASSERT_EQ(features.keypoints.size(), 1U);
  EXPECT_EQ(features.keypoints[0], (Keypoint{21, 21, 0, 254, 0}));
}

TEST(ExtractorTest, ErrorsNameTheInvalidInput) {
  const Extractor extractor;
  const cv::Mat image = NoiseImage({100, 80}, 18);
  EXPECT_THAT([&] { extractor.Extract(cv::Mat()); }, ThrowsError("image is empty"));
  EXPECT_THAT([&] { extractor.Extract(cv::Mat(80, 100, CV_8UC3)); },
              ThrowsError("image", "CV_8UC1"));
  EXPECT_THAT([&] { extractor.Extract(cv::Mat(80, 100, CV_16UC1)); }, ThrowsError("image", "type"));
  EXPECT_THAT([&] { extractor.Extract(image, cv::Mat(80, 100, CV_32FC1)); }, ThrowsError("mask"));
  EXPECT_THAT([&] { extractor.Extract(image, cv::Mat(100, 80, CV_8UC1)); },
              ThrowsError("mask is 80x100", "100x80"));
  EXPECT_THAT([] { Extractor(WithFeatures(-1)); }, ThrowsError("num_features"));
  EXPECT_THAT([] { Extractor({}, 0); }, ThrowsError("threads is 0", "1 to 256"));
}

TEST(ExtractorTest, MatchesAPlaneUnderViewpointChange) {
  CORVO_REQUIRE_DATA("oxford_affine/graf");
  const Extractor extractor(WithFeatures(1000));
  const Features first = extractor.Extract(ReadGray("oxford_affine/graf/img1.ppm"));
  const Features second = extractor.Extract(ReadGray("oxford_affine/graf/img2.ppm"));
  const cv::Matx33d second_from_first = test::ReadHomography("oxford_affine/graf/H1to2p");
  int correct = 0;
  for (const Match& match : MatchMutually(first, second)) {
    const Keypoint& from = first.keypoints[match.query];
    const Keypoint& to = second.keypoints[match.train];
    const cv::Vec3d expected = second_from_first * cv::Vec3d(from.x, from.y, 1);
    correct += std::hypot(expected[0] / expected[2] - to.x, expected[1] / expected[2] - to.y) <= 3;
  }
  EXPECT_GE(correct, 250);
}

}  // namespace
}  // namespace corvo::orb
