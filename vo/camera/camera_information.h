// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace corvo {

/// What images tell of a camera: the normal equations `matrix` * d = `vector` of its difference d
/// from the given one, see CameraPrior, with poses and points marginalized and without the prior.
/// Those of other images add to them. Both are empty if no parameter is free.
struct CameraInformation {
  Eigen::MatrixXd matrix;
  Eigen::VectorXd vector;
};

}  // namespace corvo
