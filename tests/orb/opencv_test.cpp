// SPDX-License-Identifier: MIT
#include <corvo/orb/opencv.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include <opencv2/core.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/stitching.hpp>

#include "orb/extractor.h"
#include "tests/orb/images.h"
#include "tests/support/data.h"
#include "tests/support/matchers.h"

namespace corvo::orb {
namespace {

using test::NoiseImage;
using test::ShapesImage;
using test::ThrowsError;

/// The result of detectAndCompute().
struct Detected {
  std::vector<cv::KeyPoint> keypoints;
  cv::Mat descriptors;
};

Detected DetectAndCompute(const cv::Ptr<cv::Feature2D>& features, cv::InputArray image,
                          cv::InputArray mask = cv::noArray()) {
  Detected detected;
  features->detectAndCompute(image, mask, detected.keypoints, detected.descriptors);
  return detected;
}

bool SameBytes(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_HAMMING) == 0;
}

bool SamePlace(const cv::KeyPoint& a, const cv::KeyPoint& b) {
  return a.pt == b.pt && a.octave == b.octave && a.angle == b.angle && a.size == b.size;
}

TEST(Feature2DTest, DetectAndComputeReturnsTheExtractorsFeatures) {
  const cv::Mat image = ShapesImage({400, 300}, 1);
  ExtractorOptions options;
  options.num_features = 321;
  const Features features = Extractor(options).Extract(image);
  const Detected detected = DetectAndCompute(CreateFeature2D(321), image);
  ASSERT_EQ(detected.keypoints.size(), 321U);
  EXPECT_EQ(FromDescriptorMat(detected.descriptors), features.descriptors);
  EXPECT_EQ(FromKeyPoints(detected.keypoints), features.keypoints);
  for (const cv::KeyPoint& keypoint : detected.keypoints) {
    EXPECT_FLOAT_EQ(keypoint.size, static_cast<float>(31 * std::pow(1.2, keypoint.octave)));
  }
}

TEST(Feature2DTest, OptionsReachTheExtractor) {
  ExtractorOptions options;
  options.num_features = 50;
  options.num_levels = 2;
  options.scale_factor = 2;
  for (const auto& keypoint :
       DetectAndCompute(CreateFeature2D(options, 2), ShapesImage({400, 300}, 2)).keypoints) {
    EXPECT_EQ(keypoint.size, keypoint.octave == 0 ? 31 : 62);
  }
  options.num_levels = 0;
  EXPECT_THAT([&] { CreateFeature2D(options); }, ThrowsError("num_levels"));
  EXPECT_THAT([] { CreateFeature2D(-1); }, ThrowsError("num_features"));
}

TEST(Feature2DTest, HasTheDescriptorSizeTypeAndNormOfOrb) {
  const auto corvo = CreateFeature2D(100);
  const cv::Ptr<cv::Feature2D> orb = cv::ORB::create(100);
  EXPECT_EQ(corvo->descriptorSize(), orb->descriptorSize());
  EXPECT_EQ(corvo->descriptorType(), orb->descriptorType());
  EXPECT_EQ(corvo->defaultNorm(), orb->defaultNorm());
  EXPECT_FALSE(corvo->empty());
  EXPECT_EQ(corvo->getDefaultName(), "Feature2D.corvo");
}

TEST(Feature2DTest, DetectThenComputeEqualsDetectAndCompute) {
  const cv::Mat image = ShapesImage({400, 300}, 3);
  const auto features = CreateFeature2D(200);
  const Detected at_once = DetectAndCompute(features, image);
  Detected in_two;
  features->detect(image, in_two.keypoints);
  features->compute(image, in_two.keypoints, in_two.descriptors);
  ASSERT_EQ(in_two.keypoints.size(), 200U);
  EXPECT_TRUE(SameBytes(in_two.descriptors, at_once.descriptors));
  for (int i = 0; i < 200; ++i) {
    EXPECT_TRUE(SamePlace(in_two.keypoints[i], at_once.keypoints[i])) << i;
  }
}

TEST(Feature2DTest, ComputeRemovesOnlyKeypointsAtTheBorder) {
  const cv::Mat image = ShapesImage({200, 150}, 4);
  std::vector<cv::KeyPoint> keypoints;
  cv::FAST(image, keypoints, 20);
  for (int i = 0; i < static_cast<int>(keypoints.size()); ++i) keypoints[i].class_id = i;
  const std::vector<cv::KeyPoint> given = keypoints;
  cv::Mat descriptors;
  CreateFeature2D()->compute(image, keypoints, descriptors);
  EXPECT_EQ(descriptors.rows, static_cast<int>(keypoints.size()));
  const cv::Rect inside(21, 21, 200 - 42, 150 - 42);
  std::vector<int> expected, kept;
  for (const auto& keypoint : given) {
    if (inside.contains(keypoint.pt)) expected.push_back(keypoint.class_id);
  }
  for (const auto& keypoint : keypoints) {
    kept.push_back(keypoint.class_id);
    EXPECT_EQ(keypoint.size, given[keypoint.class_id].size);
    EXPECT_GE(keypoint.angle, 0);  // cv::FAST sets none (-1).
  }
  EXPECT_LT(kept.size(), given.size());
  EXPECT_EQ(kept, expected);
}

TEST(Feature2DTest, HonorsMasks) {
  const cv::Mat image = ShapesImage({320, 240}, 5);
  cv::Mat mask = cv::Mat::zeros(image.size(), CV_8UC1);
  mask.colRange(0, 160).setTo(255);
  for (const bool unified : {false, true}) {
    std::vector<cv::KeyPoint> keypoints;
    if (unified) {
      CreateFeature2D(100)->detect(image.getUMat(cv::ACCESS_READ), keypoints,
                                   mask.getUMat(cv::ACCESS_READ));
    } else {
      CreateFeature2D(100)->detect(image, keypoints, mask);
    }
    EXPECT_EQ(keypoints.size(), 100U);
    for (const auto& keypoint : keypoints) EXPECT_LT(keypoint.pt.x, 160);
  }
}

TEST(Feature2DTest, ConvertsColorToGray) {
  const cv::Mat gray = ShapesImage({320, 240}, 6);
  cv::Mat bgr, bgra;
  cv::merge(std::vector<cv::Mat>{gray, NoiseImage(gray.size(), 7), gray}, bgr);
  cv::cvtColor(bgr, bgra, cv::COLOR_BGR2BGRA);
  cv::Mat converted;
  cv::cvtColor(bgr, converted, cv::COLOR_BGR2GRAY);
  const auto features = CreateFeature2D(100);
  const cv::Mat expected = DetectAndCompute(features, converted).descriptors;
  EXPECT_TRUE(SameBytes(DetectAndCompute(features, bgr).descriptors, expected));
  EXPECT_TRUE(SameBytes(DetectAndCompute(features, bgra).descriptors, expected));
  EXPECT_FALSE(SameBytes(DetectAndCompute(features, gray).descriptors, expected));
}

TEST(Feature2DTest, AnEmptyImageHasNoFeatures) {
  const auto features = CreateFeature2D(100);
  Detected detected = DetectAndCompute(features, ShapesImage({200, 150}, 8));
  ASSERT_FALSE(detected.keypoints.empty());
  const std::vector<cv::KeyPoint> given = detected.keypoints;
  features->detectAndCompute(cv::Mat(), cv::noArray(), detected.keypoints, detected.descriptors);
  EXPECT_TRUE(detected.keypoints.empty());
  EXPECT_TRUE(detected.descriptors.empty());
  detected.keypoints = given;
  features->detectAndCompute(cv::Mat(), cv::noArray(), detected.keypoints, detected.descriptors,
                             true);
  EXPECT_TRUE(detected.keypoints.empty());
}

TEST(Feature2DTest, InvalidInputThrowsCvException) {
  const auto features = CreateFeature2D(100);
  const cv::Mat image = ShapesImage({200, 150}, 9);
  EXPECT_THROW(DetectAndCompute(features, cv::Mat(100, 100, CV_16UC1)), cv::Exception);
  EXPECT_THROW(DetectAndCompute(features, cv::Mat(100, 100, CV_8UC2)), cv::Exception);
  EXPECT_THROW(DetectAndCompute(features, image, cv::Mat(10, 10, CV_8UC1)), cv::Exception);
  std::vector<cv::KeyPoint> keypoints;
  EXPECT_THROW(features->compute(cv::Mat(100, 100, CV_32FC1), keypoints, cv::noArray()),
               cv::Exception);
}

TEST(ConversionTest, KeyPointsRoundTrip) {
  const std::vector<Keypoint> keypoints = {{1.5F, 2, 359, 40, 0}, {3, 4.25F, 0, 7, 1}};
  const std::vector<double> scales = {1, 1.5};
  const auto converted = ToKeyPoints(keypoints, scales);
  EXPECT_EQ(FromKeyPoints(converted), keypoints);
  EXPECT_EQ(converted[1].size, 46.5F);
  EXPECT_THAT([&] { ToKeyPoints(keypoints, std::vector<double>{1}); },
              ThrowsError("octave is 1", "0 to 0"));
}

TEST(ConversionTest, DescriptorsRoundTrip) {
  const auto descriptors = test::RandomDescriptors(7, 10);
  const cv::Mat rows = ToDescriptorMat(descriptors);
  EXPECT_EQ(rows.size(), cv::Size(32, 7));
  EXPECT_EQ(FromDescriptorMat(rows), descriptors);
  EXPECT_EQ(FromDescriptorMat(rows.rowRange(2, 3)).at(0), descriptors[2]);
  EXPECT_TRUE(ToDescriptorMat({}).empty());
  EXPECT_TRUE(FromDescriptorMat({}).empty());
  EXPECT_THAT([] { FromDescriptorMat(cv::Mat(2, 31, CV_8UC1)); }, ThrowsError("31 columns"));
  EXPECT_THAT([] { FromDescriptorMat(cv::Mat(2, 32, CV_32FC1)); }, ThrowsError("type", "CV_8UC1"));
}

/// Two images of a plane and the homography between them.
struct Pair {
  cv::Mat first, second;
  cv::Matx33d second_from_first;
};

/// Returns a drawing and a copy rotated by 20 degrees about its center with slight perspective.
Pair DrawnPair() {
  const double c = std::cos(0.35), s = std::sin(0.35), x = 320, y = 240;
  Pair pair{ShapesImage({640, 480}, 11),
            {},
            {c, -s, x - c * x + s * y, s, c, y - s * x - c * y, 1e-4, -5e-5, 1}};
  cv::warpPerspective(pair.first, pair.second, pair.second_from_first, pair.first.size());
  return pair;
}

/// Counts cross-checked matches of cv::BFMatcher within 3 px of the position that the homography
/// predicts.
int CountCorrectMatches(const cv::Ptr<cv::Feature2D>& features, const Pair& pair) {
  const Detected first = DetectAndCompute(features, pair.first);
  const Detected second = DetectAndCompute(features, pair.second);
  std::vector<cv::DMatch> matches;
  cv::BFMatcher(features->defaultNorm(), true)
      .match(first.descriptors, second.descriptors, matches);
  int correct = 0;
  for (const auto& match : matches) {
    const cv::Point2f from = first.keypoints[match.queryIdx].pt;
    const cv::Vec3d to = pair.second_from_first * cv::Vec3d(from.x, from.y, 1);
    const cv::Point2f found = second.keypoints[match.trainIdx].pt;
    correct += std::hypot(to[0] / to[2] - found.x, to[1] / to[2] - found.y) <= 3;
  }
  return correct;
}

TEST(Feature2DTest, ReplacesOrbWithABruteForceMatcher) {
  const Pair pair = DrawnPair();
  for (const auto& features :
       {CreateFeature2D(1000), cv::Ptr<cv::Feature2D>(cv::ORB::create(1000))}) {
    EXPECT_GE(CountCorrectMatches(features, pair), 250) << features->getDefaultName();
  }
}

TEST(Feature2DTest, MatchesAPlaneUnderViewpointChange) {
  CORVO_REQUIRE_DATA("oxford_affine/graf");
  const Pair pair{test::ReadGray("oxford_affine/graf/img1.ppm"),
                  test::ReadGray("oxford_affine/graf/img2.ppm"),
                  test::ReadHomography("oxford_affine/graf/H1to2p")};
  EXPECT_GE(CountCorrectMatches(CreateFeature2D(1000), pair), 250);
}

TEST(Feature2DTest, StitchesTwoOverlappingImages) {
  const cv::Mat gray = ShapesImage({600, 300}, 12);
  cv::Mat whole;
  cv::applyColorMap(gray, whole, cv::COLORMAP_PARULA);
  const std::vector<cv::Mat> halves = {whole(cv::Rect(0, 0, 380, 300)),
                                       whole(cv::Rect(220, 0, 380, 300))};
  const auto stitcher = cv::Stitcher::create(cv::Stitcher::SCANS);
  stitcher->setFeaturesFinder(CreateFeature2D(500));
  cv::Mat panorama;
  ASSERT_EQ(stitcher->stitch(halves, panorama), cv::Stitcher::OK);
  EXPECT_NEAR(panorama.cols, 600, 6);
  EXPECT_NEAR(panorama.rows, 300, 6);
}

}  // namespace
}  // namespace corvo::orb
