// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <Eigen/Core>

#include "vo/optimization/bundle.h"

namespace corvo {

/// The unknowns of an adjustment, and which points are solved for jointly with the views.
struct AdjustmentState {
  std::vector<Bundle>& bundles;
  std::vector<std::vector<char>> is_joint;  ///< For each bundle and point.
  Eigen::VectorXd difference;               ///< Of the camera from the one given, see CameraPrior.
};

}  // namespace corvo
