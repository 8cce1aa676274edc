// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace corvo {

/// Corresponding rays (x/z, y/z) of two views, and their standard deviation in the same unit.
struct RayMatch {
  Eigen::Vector2d first;
  Eigen::Vector2d second;
  double sigma = 1;  ///< Standard deviation of either ray along each axis.
};

}  // namespace corvo
