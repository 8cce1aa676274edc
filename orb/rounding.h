// SPDX-License-Identifier: MIT
#pragma once

namespace corvo::orb {

/// Nearest integer of a value that is not negative; halfway goes up. Free of libm.
inline int RoundHalfUp(double value) {
  const double raised = value + 0.5;
  return static_cast<int>(raised);
}

}  // namespace corvo::orb
