// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <Eigen/Core>

#include "vo/optimization/bundle.h"

namespace corvo {

/// The unknowns of an adjustment, and the choice of points that are adjusted jointly with the
/// views.
struct AdjustmentState {
  std::vector<Bundle>& bundles;
  std::vector<std::vector<char>> is_joint;  ///< One flag for each bundle and point.
  Eigen::VectorXd difference;  ///< Difference of the camera from the given one, see CameraPrior.
};

}  // namespace corvo
