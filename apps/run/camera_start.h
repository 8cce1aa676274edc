// SPDX-License-Identifier: MIT
#pragma once

#include "apps/system/interruption.h"
#include "vo/offline/self_calibration.h"

namespace corvo {

/// Returns a progress callback that shows a self-calibration as a line on standard error and
/// cancels it if an interruption is requested. `interruption` must outlive the callback.
CalibrationProgress ShowCalibration(int num_sequences, const Interruption& interruption);

/// Logs the focal length that was found, or a warning with advice on what to record if the images
/// do not determine it.
void ReportFocalSearch(const CameraStart& start);

/// Returns the camera of a sequence without a calibration, see FindCamera(), and logs it. Throws
/// corvo::Error, and Interrupted if an interruption was requested.
CameraPrior FindSequenceCamera(const StreamOpener& sequence, const SelfCalibrationOptions& options,
                               const Interruption& interruption);

}  // namespace corvo
