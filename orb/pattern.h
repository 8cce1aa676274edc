// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace corvo::orb {

inline constexpr int kNumTests = 256;    ///< Number of tests, the bits of a descriptor.
inline constexpr int kWindowRadius = 2;  ///< A test compares sums over 5x5 windows.
inline constexpr int kMaxOffset = 13;    ///< Limit of a window center: windows fill a 31x31 patch.

/// A pixel relative to the keypoint, px of its level.
struct Offset {
  std::int8_t x = 0;
  std::int8_t y = 0;

  bool operator==(const Offset&) const = default;
};

/// A test that gives one bit of a descriptor: 1 iff the window at p is darker than the window at q.
struct BinaryTest {
  Offset p;
  Offset q;

  bool operator==(const BinaryTest&) const = default;
};

using Pattern = std::array<BinaryTest, kNumTests>;

/// Returns whether the ends are at least sqrt(2) px apart, so that they remain distinct under
/// rotation and rounding.
bool EndsApart(const BinaryTest& test);

/// Returns whether the tests are the same up to swapped ends, so that one bit determines the other.
bool AreEquivalent(const BinaryTest& a, const BinaryTest& b);

/// Makes the tests of BRIEF (Calonder et al., ECCV 2010, sampling G II): both ends are drawn
/// independently from an isotropic Gaussian of standard deviation 31/5 px, and redrawn until within
/// kMaxOffset. No two tests are equivalent, and the ends of each are apart. The result is the same
/// with every compiler.
Pattern MakeBriefPattern(std::uint64_t seed = 0);

/// The cosine and sine of `bin` / `bins` of a full turn, within 1e-15 and computed without libm;
/// directions a quarter turn apart have exactly equal magnitudes.
struct Direction {
  double cosine = 1;
  double sine = 0;
};
Direction DirectionOf(int bin, int bins);

/// Returns the index of the direction nearest to `angle_deg`, which is in [0, 360), among `bins`
/// equally spaced directions; halfway rounds up.
int NearestBin(float angle_deg, int bins);

/// Rotates an offset from x towards y and rounds it to pixels, halfway away from 0.
Offset Rotate(const Offset& offset, const Direction& direction);

/// A pattern rotated, from x towards y, to each of several equally spaced directions, with offsets
/// rounded to pixels.
class RotatedPatterns {
 public:
  /// Rotates `pattern` to `bins` directions, 1 to 256; bin b is b / bins of a full turn.
  RotatedPatterns(const Pattern& pattern, int bins);

  /// Returns the pattern of the direction nearest to `angle_deg`, which is in [0, 360).
  const Pattern& Nearest(float angle_deg) const { return patterns_[NearestBin(angle_deg)]; }
  /// Returns the index of the direction nearest to `angle_deg`.
  int NearestBin(float angle_deg) const { return orb::NearestBin(angle_deg, bins()); }
  int bins() const { return static_cast<int>(patterns_.size()); }
  const Pattern& operator[](int bin) const { return patterns_[bin]; }

 private:
  std::vector<Pattern> patterns_;
};

}  // namespace corvo::orb
