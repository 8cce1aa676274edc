// SPDX-License-Identifier: MIT
#pragma once

namespace corvo::orb {

/// Returns the nearest integer of a nonnegative value; halfway rounds up. Does not use libm.
inline int RoundHalfUp(double value) {
  const double raised = value + 0.5;
  return static_cast<int>(raised);
}

}  // namespace corvo::orb
