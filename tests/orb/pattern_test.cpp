// SPDX-License-Identifier: MIT
#include "orb/pattern.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <set>
#include <tuple>

namespace corvo::orb {
namespace {

std::uint64_t Fnv1a(const Pattern& pattern) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const BinaryTest& test : pattern) {
    for (const std::int8_t value : {test.p.x, test.p.y, test.q.x, test.q.y}) {
      hash = (hash ^ static_cast<std::uint8_t>(value)) * 0x100000001b3U;
    }
  }
  return hash;
}

Offset Negative(const Offset& offset) {
  return {static_cast<std::int8_t>(-offset.x), static_cast<std::int8_t>(-offset.y)};
}

TEST(MakeBriefPatternTest, DefaultPatternNeverChanges) {
  EXPECT_EQ(Fnv1a(MakeBriefPattern()), 0x2ab823f7f817a87aU);
  EXPECT_EQ(MakeBriefPattern(0), MakeBriefPattern());
  EXPECT_NE(MakeBriefPattern(1), MakeBriefPattern(2));
}

TEST(MakeBriefPatternTest, EndsLieInsideThePatchAndApart) {
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    for (const BinaryTest& test : MakeBriefPattern(seed)) {
      for (const int value : {test.p.x, test.p.y, test.q.x, test.q.y}) {
        EXPECT_LE(std::abs(value), kMaxOffset);
      }
      EXPECT_GE(std::hypot(test.p.x - test.q.x, test.p.y - test.q.y), std::sqrt(2.0));
    }
  }
}

TEST(MakeBriefPatternTest, NoTestIsRepeatedNorReversed) {
  std::set<std::tuple<int, int, int, int>> seen;
  for (const auto& [p, q] : MakeBriefPattern()) {
    EXPECT_TRUE(seen.insert({p.x, p.y, q.x, q.y}).second);
    EXPECT_EQ(seen.count({q.x, q.y, p.x, p.y}), 0U);
  }
}

TEST(MakeBriefPatternTest, EndsAreNormallyDistributed) {
  double sum = 0, squares = 0, products = 0;
  int count = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    for (const auto& [p, q] : MakeBriefPattern(seed)) {
      sum += p.x + p.y + q.x + q.y;
      squares += p.x * p.x + p.y * p.y + q.x * q.x + q.y * q.y;
      products += p.x * p.y + q.x * q.y;
      count += 4;
    }
  }
  EXPECT_NEAR(sum / count, 0, 0.1);
  EXPECT_NEAR(products / (count / 2.0), 0, 0.6);
  // Truncating a Gaussian of 6.2 px at 13.5 px leaves 5.6 px.
  EXPECT_NEAR(std::sqrt(squares / count), 5.6, 0.15);
}

TEST(DirectionOfTest, IsCosineAndSine) {
  for (int bins = 1; bins <= 256; ++bins) {
    for (int bin = 0; bin < bins; ++bin) {
      const double radians = 2 * std::numbers::pi * bin / bins;
      const Direction direction = DirectionOf(bin, bins);
      EXPECT_NEAR(direction.cosine, std::cos(radians), 1e-14);
      EXPECT_NEAR(direction.sine, std::sin(radians), 1e-14);
    }
  }
}

TEST(DirectionOfTest, QuarterTurnsAreExact) {
  for (const int bins : {4, 8, 36, 256}) {
    for (int bin = 0; bin < 3 * bins / 4; ++bin) {
      EXPECT_EQ(DirectionOf(bin + bins / 4, bins).cosine, -DirectionOf(bin, bins).sine);
      EXPECT_EQ(DirectionOf(bin + bins / 4, bins).sine, DirectionOf(bin, bins).cosine);
    }
  }
}

TEST(RotatedPatternsTest, FirstDirectionIsThePatternItself) {
  const Pattern pattern = MakeBriefPattern();
  EXPECT_EQ(RotatedPatterns(pattern, 30)[0], pattern);
}

TEST(RotatedPatternsTest, EveryEndIsRotatedAndRoundedToTheNearestPixel) {
  const Pattern pattern = MakeBriefPattern();
  for (const int bins : {1, 7, 30, 256}) {
    const RotatedPatterns rotated(pattern, bins);
    ASSERT_EQ(rotated.bins(), bins);
    for (int bin = 0; bin < bins; ++bin) {
      const double c = std::cos(2 * std::numbers::pi * bin / bins);
      const double s = std::sin(2 * std::numbers::pi * bin / bins);
      for (int i = 0; i < kNumTests; ++i) {
        const Offset from = pattern[i].p, to = rotated[bin][i].p;
        ASSERT_NEAR(to.x, c * from.x - s * from.y, 0.5 + 1e-9);
        ASSERT_NEAR(to.y, s * from.x + c * from.y, 0.5 + 1e-9);
      }
    }
  }
}

TEST(RotatedPatternsTest, OppositeDirectionsMirrorThePattern) {
  for (const int bins : {2, 30, 256}) {
    const RotatedPatterns rotated(MakeBriefPattern(), bins);
    for (int bin = 0; bin < bins / 2; ++bin) {
      for (int i = 0; i < kNumTests; ++i) {
        const BinaryTest& test = rotated[bin][i];
        EXPECT_EQ(rotated[bin + bins / 2][i], (BinaryTest{Negative(test.p), Negative(test.q)}));
      }
    }
  }
}

TEST(RotatedPatternsTest, EndsStayApartAndInsideTheBorder) {
  for (int bins = 1; bins <= 256; ++bins) {
    const RotatedPatterns rotated(MakeBriefPattern(), bins);
    for (int bin = 0; bin < bins; ++bin) {
      for (const auto& [p, q] : rotated[bin]) {
        ASSERT_NE(p, q);
        for (const int value : {p.x, p.y, q.x, q.y}) ASSERT_LE(std::abs(value) + kWindowRadius, 21);
      }
    }
  }
}

TEST(RotatedPatternsTest, NearestBinRoundsAndWrapsAround) {
  const RotatedPatterns rotated(MakeBriefPattern(), 30);
  EXPECT_EQ(rotated.NearestBin(0.0F), 0);
  EXPECT_EQ(rotated.NearestBin(5.99F), 0);
  EXPECT_EQ(rotated.NearestBin(6.0F), 1);
  EXPECT_EQ(rotated.NearestBin(17.99F), 1);
  EXPECT_EQ(rotated.NearestBin(348.0F), 29);
  EXPECT_EQ(rotated.NearestBin(353.99F), 29);
  EXPECT_EQ(rotated.NearestBin(354.0F), 0);
  EXPECT_EQ(rotated.NearestBin(359.9999F), 0);
  EXPECT_EQ(rotated.Nearest(17.0F), rotated[1]);
  EXPECT_EQ(RotatedPatterns(MakeBriefPattern(), 1).NearestBin(200.0F), 0);
}

}  // namespace
}  // namespace corvo::orb
