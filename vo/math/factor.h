// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace corvo {

/// Returns whether a positive ratio is between 1 / `factor` and `factor`, which is at least 1.
inline bool IsWithinFactor(double ratio, double factor) {
  return std::abs(std::log(ratio)) <= std::log(factor);
}

}  // namespace corvo
