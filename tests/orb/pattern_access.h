// SPDX-License-Identifier: MIT
#pragma once

#include "orb/pattern.h"
#include "orb/types.h"

namespace corvo::test {

/// Returns the index of a position of the patch, row by row: the inverse of PositionAt().
inline int PositionOf(const orb::Offset& offset) {
  return (offset.y + orb::kMaxOffset) * (2 * orb::kMaxOffset + 1) + offset.x + orb::kMaxOffset;
}

inline bool Bit(const orb::Descriptor& descriptor, int i) {
  return (descriptor.bytes[i / 8] >> i % 8 & 1) != 0;
}

}  // namespace corvo::test
