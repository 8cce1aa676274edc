// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "vo/camera/camera_parameters.h"

namespace corvo {

/// Reads the calibration that a dataset ships, in any form that ReadCalibrationFile() reads. `name`
/// selects one of several cameras in the file; if it is empty, the first is read. If the file does
/// not state the size of the images, it is that of `first_image`. Throws corvo::Error as
/// ReadCalibrationFile() does, and if the image is needed and cannot be read.
CameraParameters ReadDatasetCamera(const std::filesystem::path& file, const std::string& name,
                                   const std::filesystem::path& first_image);

}  // namespace corvo
