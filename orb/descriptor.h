// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "orb/kernels/patch.h"
#include "orb/pattern.h"
#include "orb/types.h"

namespace corvo::orb {

/// Distance from a level's edge within which there are no keypoints: holds the windows of a
/// pattern in any direction (13 sqrt(2), rounded up, plus 2).
inline constexpr int kBorder = 21;

/// Describes keypoints by one pattern, rotated to their direction.
class Describer {
 public:
  /// `bins` directions, 1 to 256; `upright`: the pattern is not rotated.
  Describer(const Pattern& pattern, int bins, bool upright);

  /// Descriptor of a keypoint in the direction nearest to `angle_deg`, which is in [0, 360). `sums`
  /// points at the keypoint's entry of its level's WindowSums(), whose rows are `stride` numbers
  /// apart; the keypoint is at least kBorder px from the level's edges. Bit i is 1 iff the sum at p
  /// of test i is less than that at q. Sums are exact and only compared, so a gain and an offset of
  /// the image that saturate nothing leave every bit as it is.
  Descriptor Describe(const std::uint16_t* sums, std::ptrdiff_t stride, float angle_deg) const;

 private:
  RotatedPatterns patterns_;
  bool upright_;
  std::vector<kernels::PatchTests> tests_;  ///< Of each direction.
};

}  // namespace corvo::orb
