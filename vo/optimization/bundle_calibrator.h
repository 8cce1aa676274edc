#pragma once

#include <optional>

#include "vo/camera/camera_prior.h"
#include "vo/core/options.h"
#include "vo/optimization/bundle.h"

namespace corvo {

/// As AdjustBundle, but the camera is adjusted too: known as `prior` says, from the difference
/// `start` on, to which the bundle has been adjusted: what is then over 10 sigma off is left out.
/// Returns its difference with the covariance (poses and points marginalized), or none, and the
/// bundle as it was, where the solver fails. The observations count 3.5 times what their sigmas
/// say, as measured (docs/calibration.md). At least one parameter is free. Deterministic.
std::optional<CameraEstimate> CalibrateBundle(const CameraPrior& prior,
                                              const Eigen::VectorXd& start,
                                              const CalibrationOptions& options, Bundle& bundle);

}  // namespace corvo
