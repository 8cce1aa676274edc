#pragma once

namespace corvo {

// 95% quantiles of the χ² distribution: an error of known standard deviation lies below in 95 of
// 100 cases.
inline constexpr double kChiSquare1Dof95 = 3.841458820694124;
inline constexpr double kChiSquare2Dof95 = 5.991464547107979;

}  // namespace corvo
