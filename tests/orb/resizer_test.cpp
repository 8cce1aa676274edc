// SPDX-License-Identifier: MIT
#include "orb/resizer.h"

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

const std::vector<std::pair<cv::Size, cv::Size>> kResizes = {
    {{640, 480}, {533, 400}}, {{101, 67}, {84, 56}}, {{64, 64}, {32, 32}},
    {{50, 31}, {13, 8}},      {{7, 5}, {1, 1}},      {{1, 1}, {1, 1}}};

TEST(ResizeTest, SameSizeIsTheIdentity) {
  const cv::Mat image = NoiseImage({37, 23}, 1);
  EXPECT_TRUE(test::SameImage(Resize(image, image.size()), image));
}

TEST(ResizeTest, HalfSizeAveragesFourPixels) {
  const cv::Mat image = (cv::Mat_<std::uint8_t>(2, 4) << 10, 20, 100, 101, 30, 41, 102, 104);
  const cv::Mat half = Resize(image, {2, 1});
  EXPECT_EQ(half.at<std::uint8_t>(0, 0), 25);   // 25.25
  EXPECT_EQ(half.at<std::uint8_t>(0, 1), 102);  // 101.75
}

TEST(ResizeTest, ConstantImageStaysConstant) {
  for (const int gray : {0, 1, 128, 255}) {
    for (const auto& [from, to] : kResizes) {
      const cv::Mat image(from, CV_8UC1, cv::Scalar(gray));
      EXPECT_TRUE(test::SameImage(Resize(image, to), cv::Mat(to, CV_8UC1, cv::Scalar(gray))));
    }
  }
}

TEST(ResizeTest, RampIsSampledAtPixelCenters) {
  cv::Mat ramp(60, 120, CV_8UC1);
  for (int y = 0; y < ramp.rows; ++y) {
    for (int x = 0; x < ramp.cols; ++x) {
      ramp.at<std::uint8_t>(y, x) = static_cast<std::uint8_t>(x + 2 * y);
    }
  }
  const cv::Mat small = Resize(ramp, {97, 41});
  for (int y = 0; y < small.rows; ++y) {
    for (int x = 0; x < small.cols; ++x) {
      const double expected = ((x + 0.5) * 120 / 97 - 0.5) + 2 * ((y + 0.5) * 60 / 41 - 0.5);
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
      EXPECT_TRUE(test::SameImage(Resize(turned_image, to), turned)) << from << " flipped " << axes;
    }
    cv::rotate(image, turned_image, cv::ROTATE_90_CLOCKWISE);
    cv::rotate(resized, turned, cv::ROTATE_90_CLOCKWISE);
    EXPECT_TRUE(test::SameImage(Resize(turned_image, turned.size()), turned)) << from;
  }
}

TEST(ResizeTest, AgreesWithOpenCvBilinearResize) {
  const cv::Mat image = ShapesImage({320, 240}, 3);
  cv::Mat expected;
  cv::resize(image, expected, {267, 200}, 0, 0, cv::INTER_LINEAR);
  EXPECT_LE(cv::norm(Resize(image, {267, 200}), expected, cv::NORM_INF), 2);
}

TEST(ResizerTest, AnyPartitionOfTheRowsGivesTheSameImage) {
  const cv::Mat image = test::NoiseImage({211, 97}, 8);
  const Resizer resizer(image.size(), {176, 81});
  const cv::Mat whole = Resize(image, resizer.to());
  for (const int begin : {1, 40, 80}) {
    cv::Mat resized(resizer.to(), CV_8UC1, cv::Scalar(0));
    Resizer::RowCache cache;
    resizer.ResizeRows(image, begin, 81, cache, resized);
    resizer.ResizeRows(image, 0, begin, cache, resized);
    EXPECT_TRUE(test::SameImage(resized, whole)) << begin;
  }
}

}  // namespace
}  // namespace corvo::orb
