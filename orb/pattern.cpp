// SPDX-License-Identifier: MIT
#include "orb/pattern.h"

#include <algorithm>
#include <numbers>

#include "orb/rounding.h"

namespace corvo::orb {
namespace {

/// The generator of Steele, Lea and Flood, "Fast splittable pseudorandom number generators", OOPSLA
/// 2014.
class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : state_(seed) {}

  std::uint64_t Next() {
    state_ += 0x9E3779B97F4A7C15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31);
  }

 private:
  std::uint64_t state_;
};

/// Returns a rounded sample of a Gaussian of standard deviation 6.2. The sum of twelve uniform
/// integers, each of n values, has variance n^2 - 1; here it is in sixteenths of a pixel.
int SampleGaussian(SplitMix64& random) {
  constexpr int kDraws = 12;
  constexpr int kValues = 99;
  constexpr int kMean = kDraws * (kValues - 1) / 2;
  constexpr int kBias = 1024;  // A multiple of 16 that keeps the dividend positive.
  int sum = 0;
  for (int i = 0; i < kDraws; ++i) sum += static_cast<int>(random.Next() % kValues);
  return (sum - kMean + 8 + kBias) / 16 - kBias / 16;
}

int SampleCoordinate(SplitMix64& random) {
  int value = kMaxOffset + 1;
  while (value < -kMaxOffset || value > kMaxOffset) value = SampleGaussian(random);
  return value;
}

Offset SampleOffset(SplitMix64& random) {
  const int x = SampleCoordinate(random);
  const int y = SampleCoordinate(random);
  return {static_cast<std::int8_t>(x), static_cast<std::int8_t>(y)};
}

int RoundHalfAway(double value) { return value < 0 ? -RoundHalfUp(-value) : RoundHalfUp(value); }

Pattern Rotate(const Pattern& pattern, const Direction& direction) {
  Pattern rotated;
  std::transform(pattern.begin(), pattern.end(), rotated.begin(), [&](const BinaryTest& test) {
    return BinaryTest{Rotate(test.p, direction), Rotate(test.q, direction)};
  });
  return rotated;
}

/// Returns cosine and sine by their Taylor series, for angles of up to a quarter turn.
Direction DirectionInQuadrant(double radians) {
  const double square = radians * radians;
  Direction direction{0.0, 0.0};
  for (int k = 24; k >= 2; k -= 2) {
    direction.cosine = (1.0 + direction.cosine) * -square / (k * (k - 1));
    direction.sine = (1.0 + direction.sine) * -square / (k * (k + 1));
  }
  return {1.0 + direction.cosine, radians * (1.0 + direction.sine)};
}

}  // namespace

bool EndsApart(const BinaryTest& test) {
  const int dx = test.p.x - test.q.x;
  const int dy = test.p.y - test.q.y;
  return dx * dx + dy * dy >= 2;
}

bool AreEquivalent(const BinaryTest& a, const BinaryTest& b) {
  return a == b || a == BinaryTest{b.q, b.p};
}

Pattern MakeBriefPattern(std::uint64_t seed) {
  SplitMix64 random(seed);
  Pattern pattern;
  for (auto next = pattern.begin(); next != pattern.end();) {
    const Offset p = SampleOffset(random);
    const Offset q = SampleOffset(random);
    const BinaryTest test{p, q};
    const bool repeated = std::any_of(
        pattern.begin(), next, [&](const BinaryTest& other) { return AreEquivalent(test, other); });
    if (EndsApart(test) && !repeated) *next++ = test;
  }
  return pattern;
}

Direction DirectionOf(int bin, int bins) {
  const int quadrant = 4 * bin / bins;
  const int rest = 4 * bin % bins;
  const Direction first = DirectionInQuadrant(std::numbers::pi / 2 * rest / bins);
  switch (quadrant % 4) {
    case 1:
      return {-first.sine, first.cosine};
    case 2:
      return {-first.cosine, -first.sine};
    case 3:
      return {first.sine, -first.cosine};
    default:
      return first;
  }
}

int NearestBin(float angle_deg, int bins) {
  const int bin = RoundHalfUp(static_cast<double>(angle_deg) * bins / 360.0);
  return bin == bins ? 0 : bin;
}

Offset Rotate(const Offset& offset, const Direction& direction) {
  const double x = direction.cosine * offset.x - direction.sine * offset.y;
  const double y = direction.sine * offset.x + direction.cosine * offset.y;
  return {static_cast<std::int8_t>(RoundHalfAway(x)), static_cast<std::int8_t>(RoundHalfAway(y))};
}

RotatedPatterns::RotatedPatterns(const Pattern& pattern, int bins) {
  patterns_.reserve(bins);
  for (int bin = 0; bin < bins; ++bin) patterns_.push_back(Rotate(pattern, DirectionOf(bin, bins)));
}

}  // namespace corvo::orb
