// SPDX-License-Identifier: MIT
#include "bench/quality/views.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "orb/error.h"
#include "tests/support/matchers.h"

namespace corvo::bench {
namespace {

const cv::Size kViewSize(101, 81);

/// Returns an image of blobs at random positions.
cv::Mat Blobs() {
  cv::Mat image(kViewSize, CV_8U, cv::Scalar(50));
  cv::RNG random(3);
  for (int i = 0; i < 12; ++i) {
    const int x = random.uniform(25, 76);
    const int y = random.uniform(25, 56);
    const int radius = random.uniform(2, 6);
    const int gray = random.uniform(80, 255);
    cv::circle(image, {x, y}, radius, cv::Scalar(gray), cv::FILLED);
  }
  cv::GaussianBlur(image, image, cv::Size(), 2.5);
  return image;
}

/// Returns the mean absolute difference between a view and the image over the pixels near the image
/// center.
double MeanDifference(const cv::Mat& image, const View& view) {
  double sum = 0;
  int count = 0;
  for (int y = 25; y < 56; ++y) {
    for (int x = 35; x < 66; ++x) {
      const cv::Vec3d to = view.from_first * cv::Vec3d(x, y, 1);
      cv::Mat patch;
      cv::getRectSubPix(view.image, cv::Size(1, 1),
                        cv::Point2f(static_cast<float>(to[0]), static_cast<float>(to[1])), patch);
      sum += std::abs(patch.at<std::uint8_t>(0, 0) - image.at<std::uint8_t>(y, x));
      ++count;
    }
  }
  return sum / count;
}

TEST(QualityViewsTest, PixelsLieWhereTheHomographyMapsThem) {
  const cv::Mat image = Blobs();
  for (const double angle : {0.0, 10.0, 90.0, 200.0, 350.0}) {
    EXPECT_LT(MeanDifference(image, Rotate(image, angle)), 2) << angle << " degrees";
  }
  for (const double factor : {0.5, 0.8, 1.25, 2.0}) {
    EXPECT_LT(MeanDifference(image, Scale(image, factor)), 3) << factor;
  }
  View wrong = Rotate(image, 30);
  wrong.from_first = Rotate(image, -30).from_first;
  EXPECT_GT(MeanDifference(image, wrong), 8);
}

TEST(QualityViewsTest, AngleGoesFromXTowardsY) {
  const cv::Vec3d moved = Rotate(Blobs(), 90).from_first * cv::Vec3d(60, 40, 1);
  EXPECT_NEAR(moved[0], 50, 1e-9);
  EXPECT_NEAR(moved[1], 50, 1e-9);
}

TEST(QualityViewsTest, ScaleKeepsTheOuterEdges) {
  const View half = Scale(Blobs(), 0.5);
  const cv::Vec3d corner = half.from_first * cv::Vec3d(-0.5, -0.5, 1);
  const cv::Vec3d opposite = half.from_first * cv::Vec3d(100.5, 80.5, 1);
  EXPECT_NEAR(corner[0], -0.5, 1e-9);
  EXPECT_NEAR(opposite[0], half.image.cols - 0.5, 1e-9);
  EXPECT_NEAR(opposite[1], half.image.rows - 0.5, 1e-9);
}

TEST(QualityViewsTest, BrightnessAndContrastAreLinearAndSaturate) {
  const cv::Mat image = (cv::Mat_<std::uint8_t>(1, 4) << 0, 100, 128, 250);
  const cv::Mat brighter = (cv::Mat_<std::uint8_t>(1, 4) << 30, 130, 158, 255);
  const cv::Mat contrast = (cv::Mat_<std::uint8_t>(1, 4) << 0, 72, 128, 255);
  EXPECT_EQ(cv::norm(AddBrightness(image, 30).image, brighter, cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(ChangeContrast(image, 2).image, contrast, cv::NORM_INF), 0);
}

TEST(QualityViewsTest, NoiseHasTheGivenSigmaAndDependsOnTheSeedOnly) {
  const cv::Mat image(200, 200, CV_8U, cv::Scalar(128));
  cv::Scalar mean, deviation;
  cv::meanStdDev(AddNoise(image, 10, 1), mean, deviation);
  EXPECT_NEAR(mean[0], 128, 0.3);
  EXPECT_NEAR(deviation[0], 10, 0.3);
  EXPECT_EQ(cv::norm(AddNoise(image, 10, 1), AddNoise(image, 10, 1), cv::NORM_INF), 0);
  EXPECT_GT(cv::norm(AddNoise(image, 10, 1), AddNoise(image, 10, 2), cv::NORM_INF), 0);
  EXPECT_EQ(cv::norm(AddNoise(image, 0, 1), image, cv::NORM_INF), 0);
}

TEST(QualityViewsTest, BlurAndJpegRemoveDetail) {
  const cv::Mat image = AddNoise(Blobs(), 20, 1);
  const auto detail = [](const cv::Mat& of) {
    cv::Mat edges;
    cv::Laplacian(of, edges, CV_32F);
    return cv::norm(edges);
  };
  EXPECT_LT(detail(Blur(image, 2).image), detail(Blur(image, 1).image));
  EXPECT_LT(detail(Blur(image, 1).image), detail(image));
  EXPECT_LT(cv::norm(CompressJpeg(image, 90).image, image),
            cv::norm(CompressJpeg(image, 10).image, image));
}

TEST(QualityViewsTest, HomographyFileHasNineNumbers) {
  const auto file = std::filesystem::path(testing::TempDir()) / "corvo_quality_homography";
  std::ofstream(file) << "1 2 3\n4 5 6\n 7e-1 8 9\n";
  EXPECT_EQ(ReadHomography(file), cv::Matx33d(1, 2, 3, 4, 5, 6, 0.7, 8, 9));
  std::ofstream(file) << "1 2 3\n4 5 6\n7 8\n";
  EXPECT_THAT([&] { ReadHomography(file); }, test::ThrowsError("three lines of three numbers"));
  std::filesystem::remove(file);
}

}  // namespace
}  // namespace corvo::bench
