// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "vo/camera/camera_prior.h"
#include "vo/optimization/adjustment_state.h"

namespace corvo {

/// Returns the covariance of a camera's difference from the given one, determined by the prior and
/// the inlier observations of the joint points. All poses (fixed ones are known exactly) and points
/// are marginalized by Schur complements of the normal equations, which are sparse in the views.
/// Returns infinities if the free parameters cannot be distinguished, and an empty matrix if none
/// is free. Throws corvo::Error if the difference does not yield a valid camera.
Eigen::MatrixXd CameraCovariance(const CameraPrior& prior, const AdjustmentState& state);

}  // namespace corvo
