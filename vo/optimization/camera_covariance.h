// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "vo/camera/camera_information.h"
#include "vo/camera/camera_prior.h"
#include "vo/optimization/adjustment_state.h"

namespace corvo {

/// Returns the information of the inlier observations of the joint points about the difference of a
/// camera from the given one, linearized at the state. All poses (fixed ones are known exactly) and
/// points are marginalized by Schur complements of the normal equations, which are sparse in the
/// views. Both parts are empty if no parameter is free. Throws corvo::Error if the difference does
/// not yield a valid camera.
CameraInformation ObservedInformation(const CameraPrior& prior, const AdjustmentState& state);

/// Returns the covariance of the difference, given this information and the prior: infinities if
/// the free parameters cannot be distinguished, and an empty matrix if none is free.
Eigen::MatrixXd CameraCovariance(const CameraPrior& prior, const Eigen::MatrixXd& information);

}  // namespace corvo
