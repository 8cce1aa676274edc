#pragma once

#include <optional>

#include "vo/bundle.h"
#include "vo/calibration.h"
#include "vo/options.h"

namespace corvo {

/// As AdjustBundle, but the camera is adjusted too: the given one, known to the sigmas in
/// `options`, from `start` on. Returns the calibration with its covariance (poses and points
/// marginalised), or none, and the bundle as it was, where the solver fails. Deterministic.
std::optional<CalibrationEstimate> CalibrateBundle(const CameraParameters& given,
                                                   const Calibration& start,
                                                   const CalibrationOptions& options,
                                                   Bundle& bundle);

}  // namespace corvo
