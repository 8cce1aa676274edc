// SPDX-License-Identifier: MIT
#include "orb/orientation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <opencv2/core.hpp>

#include "tests/orb/images.h"

namespace corvo::orb {
namespace {

/// Returns the absolute difference of two directions, deg, in [0, 180].
double AngleBetween(double a_deg, double b_deg) {
  return std::abs(std::remainder(a_deg - b_deg, 360.0));
}

double TrueDirectionDeg(double x, double y) { return std::atan2(y, x) * 180 / std::numbers::pi; }

TEST(DirectionDegTest, AxesAndDiagonalsAreExact) {
  EXPECT_EQ(DirectionDeg(7, 0), 0.0F);
  EXPECT_EQ(DirectionDeg(7, 7), 45.0F);
  EXPECT_EQ(DirectionDeg(0, 7), 90.0F);
  EXPECT_EQ(DirectionDeg(-7, 7), 135.0F);
  EXPECT_EQ(DirectionDeg(-7, 0), 180.0F);
  EXPECT_EQ(DirectionDeg(-7, -7), 225.0F);
  EXPECT_EQ(DirectionDeg(0, -7), 270.0F);
  EXPECT_EQ(DirectionDeg(7, -7), 315.0F);
  EXPECT_EQ(DirectionDeg(0, 0), 0.0F);
}

TEST(DirectionDegTest, IsTheArctangent) {
  for (int i = 0; i < 7200; ++i) {
    const double radians = i * std::numbers::pi / 3600;
    const double x = std::cos(radians) * 12345, y = std::sin(radians) * 12345;
    const float degrees = DirectionDeg(x, y);
    EXPECT_GE(degrees, 0.0F);
    EXPECT_LT(degrees, 360.0F);
    EXPECT_LT(AngleBetween(degrees, TrueDirectionDeg(x, y)), 3e-5) << i;
  }
}

TEST(DirectionDegTest, NeverReaches360) {
  EXPECT_EQ(DirectionDeg(1e9, -1), 0.0F);
  EXPECT_LT(DirectionDeg(1e4, -1), 360.0F);
}

TEST(OrientationDegTest, IsInvariantToABrightnessOffset) {
  const cv::Mat image = test::NoiseImage({33, 33}, 2) / 2;
  EXPECT_EQ(OrientationDeg(image, 16, 16), OrientationDeg(image + cv::Scalar(100), 16, 16));
}

TEST(OrientationDegTest, PointsAlongTheGradientOfARamp) {
  for (const double direction_deg : {0.0, 30.0, 100.0, 200.0, 333.0}) {
    const double radians = direction_deg * std::numbers::pi / 180;
    cv::Mat ramp(33, 33, CV_8UC1);
    for (int y = 0; y < 33; ++y) {
      for (int x = 0; x < 33; ++x) {
        const double along = (x - 16) * std::cos(radians) + (y - 16) * std::sin(radians);
        ramp.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(128 + 5 * along);
      }
    }
    EXPECT_LT(AngleBetween(OrientationDeg(ramp, 16, 16), direction_deg), 0.2);
  }
}

TEST(OrientationDegTest, RotatesWithTheImage) {
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const cv::Mat image = test::NoiseImage({33, 33}, seed);
    cv::Mat turned;
    cv::rotate(image, turned, cv::ROTATE_90_CLOCKWISE);  // x towards y: by +90 degrees
    EXPECT_LT(AngleBetween(OrientationDeg(turned, 16, 16), OrientationDeg(image, 16, 16) + 90.0),
              1e-4);
  }
}

TEST(OrientationDegTest, BlankImageHasDirectionZero) {
  EXPECT_EQ(OrientationDeg(cv::Mat(33, 33, CV_8UC1, cv::Scalar(200)), 16, 16), 0.0F);
}

}  // namespace
}  // namespace corvo::orb
