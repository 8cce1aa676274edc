// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "apps/dataset/camera_formats/calibration_file.h"

namespace corvo {

/// Reads the camera that the option --camera names: a calibration file, "FILE:NAME" for one of the
/// cameras in a file, or the name of a camera that is shipped with corvo. An existing file precedes
/// the other two. Throws corvo::Error as ReadCalibrationFile() does, and with the names of the
/// shipped cameras if there is neither a file nor a camera of that name.
CalibrationFile ReadNamedCamera(const std::filesystem::path& named);

}  // namespace corvo
