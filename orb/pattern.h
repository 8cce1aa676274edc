// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace corvo::orb {

inline constexpr int kNumTests = 256;    ///< Bits of a descriptor.
inline constexpr int kWindowRadius = 2;  ///< A test compares sums over 5x5 windows.
inline constexpr int kMaxOffset = 13;    ///< Of a window's center: windows fill the 31x31 patch.

/// A pixel relative to the keypoint, px of its level.
struct Offset {
  std::int8_t x = 0;
  std::int8_t y = 0;

  bool operator==(const Offset&) const = default;
};

/// One bit of a descriptor: is the window at p darker than the window at q?
struct BinaryTest {
  Offset p;
  Offset q;

  bool operator==(const BinaryTest&) const = default;
};

using Pattern = std::array<BinaryTest, kNumTests>;

/// At least sqrt(2) px apart, so that the ends stay apart under rotation and rounding.
bool EndsApart(const BinaryTest& test);

/// The same test, or the same with its ends swapped: its bit tells nothing new.
bool AreEquivalent(const BinaryTest& a, const BinaryTest& b);

/// The tests of BRIEF (Calonder et al., ECCV 2010, sampling G II): both ends drawn independently
/// from an isotropic Gaussian of standard deviation 31/5 px, redrawn until within kMaxOffset. No
/// two tests are equivalent, and their ends are apart. The same bits with every compiler.
Pattern MakeBriefPattern(std::uint64_t seed = 0);

/// Cosine and sine of `bin` / `bins` of a full turn, within 1e-15 and free of libm; directions a
/// quarter turn apart have exactly equal magnitudes.
struct Direction {
  double cosine = 1;
  double sine = 0;
};
Direction DirectionOf(int bin, int bins);

/// Of `bins` equally spaced directions the one nearest to `angle_deg`, which is in [0, 360);
/// halfway goes up.
int NearestBin(float angle_deg, int bins);

/// Rotates from x towards y, and rounds to pixels, halfway away from 0.
Offset Rotate(const Offset& offset, const Direction& direction);

/// A pattern rotated, from x towards y, to each of equally spaced directions, rounded to pixels.
class RotatedPatterns {
 public:
  /// `bins` is 1 to 256; bin b stands for b / bins of a full turn.
  RotatedPatterns(const Pattern& pattern, int bins);

  /// The pattern of the direction nearest to `angle_deg`, which is in [0, 360).
  const Pattern& Nearest(float angle_deg) const { return patterns_[NearestBin(angle_deg)]; }
  /// Index of that direction.
  int NearestBin(float angle_deg) const { return orb::NearestBin(angle_deg, bins()); }
  int bins() const { return static_cast<int>(patterns_.size()); }
  const Pattern& operator[](int bin) const { return patterns_[bin]; }

 private:
  std::vector<Pattern> patterns_;
};

}  // namespace corvo::orb
