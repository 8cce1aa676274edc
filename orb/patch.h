// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

namespace corvo::orb {

/// The pixels around a keypoint, in the pyramid level in which it was detected.
struct Patch {
  static constexpr int kRadius = 8;
  static constexpr int kSide = 2 * kRadius + 1;

  std::array<std::uint8_t, kSide * kSide> pixels{};  ///< Row by row; the keypoint is in the center.

  bool operator==(const Patch&) const = default;
};

}  // namespace corvo::orb
