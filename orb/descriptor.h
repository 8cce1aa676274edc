// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "orb/kernels/patch.h"
#include "orb/pattern.h"
#include "orb/types.h"

namespace corvo::orb {

/// The distance from a level's edges within which there are no keypoints. It leaves room for the
/// windows of a pattern in any direction (13 sqrt(2), rounded up, plus 2).
inline constexpr int kBorder = 21;

/// Describes keypoints with one pattern that is rotated to their direction.
class Describer {
 public:
  /// The pattern is rotated to `bins` equally spaced directions, 1 to 256; if `upright`, it is
  /// never rotated.
  Describer(const Pattern& pattern, int bins, bool upright);

  /// Returns the descriptor of a keypoint, using the direction nearest to `angle_deg`, which is in
  /// [0, 360). `sums` points to the keypoint's element of WindowSums() of its level; `stride` is
  /// the number of elements from one row to the next. The keypoint is at least kBorder px from the
  /// level's edges. Bit i is 1 iff the sum at p of test i is less than the sum at q. The sums are
  /// exact and are only compared, so a change of gain and offset that saturates no pixel changes no
  /// bit.
  Descriptor Describe(const std::uint16_t* sums, std::ptrdiff_t stride, float angle_deg) const;

 private:
  RotatedPatterns patterns_;
  bool upright_;
  std::vector<kernels::PatchTests> tests_;  ///< The rotated tests, by direction.
};

}  // namespace corvo::orb
