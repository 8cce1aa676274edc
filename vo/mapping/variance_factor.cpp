// SPDX-License-Identifier: MIT
#include "vo/mapping/variance_factor.h"

namespace corvo {

void VarianceFactor::Add(const PoseDependence& frame) {
  aligned_.Add(frame.aligned);
  detected_.Add(frame.detected);
}

double VarianceFactor::Of(const PoseDependence& frame) const {
  const int count = frame.aligned.count + frame.detected.count;
  if (count == 0) return 1;
  return (frame.aligned.count * aligned_.value + frame.detected.count * detected_.value) / count;
}

void VarianceFactor::Mean::Add(const SquaredErrors& errors) {
  constexpr double kWeight = 0.1;  // Of the newest frame: the mean is over about ten frames.
  constexpr int kMinCount = 20;    // Fewer numbers say little.
  if (errors.count < kMinCount) return;
  const double mean = errors.sum / errors.count;
  value = is_known ? value + kWeight * (mean - value) : mean;
  is_known = true;
}

}  // namespace corvo
