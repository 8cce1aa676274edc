// SPDX-License-Identifier: MIT
#include "tests/support/random.h"

#include <gmock/gmock.h>

#include <set>

namespace corvo::test {
namespace {

TEST(RandomTest, IsSplitMix64) {
  Random random(1234567);  // First outputs of the published reference implementation.
  EXPECT_EQ(random.Bits(), 6457827717110365317u);
  EXPECT_EQ(random.Bits(), 3203168211198807973u);
}

TEST(RandomTest, UniformFillsItsRange) {
  Random random(1);
  double min = 1e9, max = -1e9, sum = 0;
  for (int i = 0; i < 10000; ++i) {
    const double value = random.Uniform(-2, 4);
    min = std::min(min, value);
    max = std::max(max, value);
    sum += value;
  }
  EXPECT_GE(min, -2);
  EXPECT_LT(max, 4);
  EXPECT_LT(min, -1.99);
  EXPECT_GT(max, 3.99);
  EXPECT_NEAR(sum / 10000, 1, 0.1);
}

TEST(RandomTest, UniformIntReachesBothEnds) {
  Random random(2);
  std::set<int> values;
  for (int i = 0; i < 200; ++i) values.insert(random.UniformInt(-1, 2));
  EXPECT_EQ(values, (std::set<int>{-1, 0, 1, 2}));
}

TEST(RandomTest, GaussianHasItsMoments) {
  Random random(3);
  double sum = 0, squares = 0;
  for (int i = 0; i < 20000; ++i) {
    const double value = random.Gaussian(2);
    sum += value;
    squares += value * value;
  }
  EXPECT_NEAR(sum / 20000, 0, 0.05);
  EXPECT_NEAR(squares / 20000, 4, 0.15);
}

TEST(RandomTest, PosesStayWithinTheirBounds) {
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    const SE3 pose = random.Pose(0.5, 3);
    EXPECT_LE(pose.rotation().Angle(), 0.5);
    EXPECT_LE(pose.translation().norm(), 3);
  }
}

}  // namespace
}  // namespace corvo::test
