// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "vo/camera/camera_prior.h"
#include "vo/optimization/adjustment_state.h"

namespace corvo {

/// Covariance of a camera's difference from the one given, by the prior and by the inliers of
/// bundles that it saw, of the joint points alone; all poses (fixed ones are known exactly) and
/// points are marginalized: Schur complements of the normal equations, sparse in the views.
/// Infinite where nothing tells the free parameters apart, empty where nothing is free. Throws
/// corvo::Error where the difference is not that of a camera.
Eigen::MatrixXd CameraCovariance(const CameraPrior& prior, const AdjustmentState& state);

}  // namespace corvo
