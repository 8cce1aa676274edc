// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <Eigen/Core>

#include "vo/core/conventions.h"
#include "vo/lie/se3.h"

namespace corvo {

/// A landmark of the initial map.
struct InitialPoint {
  int first_keypoint = kNoId;
  int second_keypoint = kNoId;
  Eigen::Vector3d in_first;
};

/// Two views and the points triangulated from them. The median depth in the first view is 1.
struct InitialMap {
  SE3 first_from_second;
  std::vector<InitialPoint> points;
};

}  // namespace corvo
