// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace corvo {

/// A loss of a squared error and its derivative, the weight.
struct Loss {
  double value;
  double weight;
};

/// Returns Huber's loss of a squared error s: s up to `threshold`, 2 √(threshold s) - threshold
/// above.
inline Loss HuberLoss(double squared_error, double threshold) {
  if (squared_error <= threshold) return {squared_error, 1.0};
  const double delta = std::sqrt(threshold);
  const double error = std::sqrt(squared_error);
  return {2 * delta * error - threshold, delta / error};
}

}  // namespace corvo
