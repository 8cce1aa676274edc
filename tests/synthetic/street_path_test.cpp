// SPDX-License-Identifier: MIT
#include "apps/synthetic/street_path.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>

namespace corvo::synthetic {
namespace {

TEST(StreetPath, StartsAtTheOriginAlongX) {
  const StreetPath::Place start = StreetPath(100).At(0);
  EXPECT_EQ(start.position, Eigen::Vector2d(0, 0));
  EXPECT_EQ(start.heading, 0);
}

TEST(StreetPath, IsParameterizedByArcLength) {
  const StreetPath path(400);
  for (double distance = 0; distance < 395; distance += 3.7) {
    const Eigen::Vector2d step = path.At(distance + 0.5).position - path.At(distance).position;
    EXPECT_NEAR(step.norm(), 0.5, 2e-4) << distance;
  }
}

TEST(StreetPath, TurnsSmoothly) {
  const StreetPath path(800);
  double sharpest = 0;
  for (double distance = 0; distance < 795; distance += 0.5) {
    const double before = path.At(distance).curvature, after = path.At(distance + 0.5).curvature;
    EXPECT_LT(std::abs(after - before), 0.01) << distance;
    sharpest = std::max(sharpest, after);
  }
  EXPECT_NEAR(sharpest, 1.0 / 12, 1e-6);
}

/// After a right-angle turn to the left the road runs along y, and later along x again.
TEST(StreetPath, TurnsLeftThenRight) {
  const StreetPath path(600);
  EXPECT_NEAR(path.At(165).heading, 1.5707963, 1e-6);
  EXPECT_NEAR(path.At(375).heading, 0, 1e-6);
}

TEST(StreetPath, NeverComesNearItself) {
  const StreetPath path(2000);
  for (double distance = 0; distance < 1900; distance += 5) {
    EXPECT_GT(path.Clearance(path.At(distance).position, distance + 60, 2000), 35) << distance;
  }
}

TEST(StreetPath, DoesNotDependOnTheRequestedLength) {
  const StreetPath::Place a = StreetPath(200).At(150), b = StreetPath(2000).At(150);
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(a.heading, b.heading);
}

}  // namespace
}  // namespace corvo::synthetic
