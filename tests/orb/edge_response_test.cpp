// SPDX-License-Identifier: MIT
#include "orb/edge_response.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace corvo::orb {
namespace {

/// Returns the patch with these gray values at offsets from its center.
Patch Draw(const std::function<double(double x, double y)>& gray) {
  Patch patch;
  for (int i = 0; i < Patch::kSide * Patch::kSide; ++i) {
    const int x = i % Patch::kSide - Patch::kRadius, y = i / Patch::kSide - Patch::kRadius;
    patch.pixels[i] = static_cast<std::uint8_t>(std::lround(gray(x, y)));
  }
  return patch;
}

/// Returns 0 on one side of a slightly blurred step and 1 on the other.
double Step(double distance) { return 0.5 + 0.5 * std::tanh(distance); }

TEST(EigenvalueShareTest, IsAboutZeroOnStraightEdgesAndOnLines) {
  for (int degrees = 0; degrees < 180; degrees += 15) {
    const double angle = degrees * std::numbers::pi / 180;
    const auto distance = [&](double x, double y) {
      return x * std::cos(angle) + y * std::sin(angle);
    };
    const auto edge = [&](double x, double y) { return 40 + 150 * Step(distance(x, y)); };
    EXPECT_LT(EigenvalueShare(Draw(edge)), 0.005) << degrees;
    const auto line = [&](double x, double y) {
      return 200 - 150 * std::exp(-std::pow(distance(x, y), 2));
    };
    EXPECT_LT(EigenvalueShare(Draw(line)), 0.015) << degrees;
  }
}

TEST(EigenvalueShareTest, IsOneForEqualTextureInAllDirections) {
  const auto blob = [](double x, double y) { return 200 * std::exp(-(x * x + y * y) / 8); };
  EXPECT_NEAR(EigenvalueShare(Draw(blob)), 1, 1e-9);
}

TEST(EigenvalueShareTest, CornersExceedEdgesAtAnyContrast) {
  for (const double contrast : {20.0, 200.0}) {
    const auto corner = [&](double x, double y) { return 20 + contrast * Step(x) * Step(y); };
    EXPECT_GT(EigenvalueShare(Draw(corner)), 0.5) << contrast;
  }
}

TEST(EigenvalueShareTest, IsTheSquaredRatioOfPerpendicularGradients) {
  const auto ramp = [](double x, double y) { return 128 + 4 * std::abs(x) + 8 * std::abs(y); };
  EXPECT_NEAR(EigenvalueShare(Draw(ramp)), 0.25, 1e-9);
}

TEST(EigenvalueShareTest, IsZeroWithoutTexture) {
  EXPECT_EQ(EigenvalueShare(Draw([](double, double) { return 77.0; })), 0);
}

}  // namespace
}  // namespace corvo::orb
