// SPDX-License-Identifier: MIT
#pragma once

#include "apps/run/interruption.h"
#include "vo/offline/self_calibration.h"

namespace corvo {

/// Shows a self-calibration as a line on standard error; ends it when an interruption is requested.
CalibrationProgress ShowCalibration(int num_sequences, const Interruption& interruption);

/// Says on standard error which focal length was found, and what to record where the images do not
/// determine it.
void ReportFocalSearch(const CameraStart& start);

/// The camera of a sequence without a calibration, see FindCamera; says what was found. Throws
/// corvo::Error and Interrupted.
CameraPrior FindSequenceCamera(const StreamOpener& sequence, const SelfCalibrationOptions& options,
                               const Interruption& interruption);

}  // namespace corvo
