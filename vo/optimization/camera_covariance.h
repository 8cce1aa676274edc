#pragma once

#include <vector>

#include <Eigen/Core>

#include "vo/camera/camera_prior.h"
#include "vo/optimization/bundle.h"

namespace corvo {

/// Covariance of a camera's difference from the one given, by the prior and by the inliers of
/// bundles that it saw, all poses (fixed ones are known exactly) and points marginalized: Schur
/// complements of the normal equations, sparse in the views. Infinite where nothing tells the free
/// parameters apart. Throws corvo::Error where the difference is no camera's.
Eigen::MatrixXd CameraCovariance(const CameraPrior& prior, const Eigen::VectorXd& difference,
                                 const std::vector<Bundle>& bundles);

}  // namespace corvo
