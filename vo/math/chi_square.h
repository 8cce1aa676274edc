// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace corvo {

// The 95% quantiles of the χ² distribution: the normalized squared error of a correct measurement
// lies below the quantile in 95 of 100 cases.
inline constexpr double kChiSquare1Dof95 = 3.841458820694124;
inline constexpr double kChiSquare2Dof95 = 5.991464547107979;

/// The 99.9% quantiles of the χ² distribution with 0, 1, 2, ... degrees of freedom.
inline constexpr double kChiSquare999[] = {0,      10.828, 13.816, 16.266, 18.467, 20.515, 22.458,
                                           24.322, 26.124, 27.877, 29.588, 31.264, 32.909};

/// Returns the 99.9% quantile for any number of degrees of freedom above 0, to 4% (Wilson and
/// Hilferty 1931).
inline double ChiSquare999(int degrees_of_freedom) {
  constexpr double kNormal999 = 3.090232306167813;  // The quantile of the normal distribution.
  const double variance = 2.0 / (9.0 * degrees_of_freedom);
  return degrees_of_freedom * std::pow(1 - variance + kNormal999 * std::sqrt(variance), 3);
}

}  // namespace corvo
