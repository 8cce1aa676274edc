// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "apps/dataset/camera_formats/stated_camera.h"

namespace corvo {

/// A camera of a calibration file.
struct CalibrationFile {
  StatedCamera camera;
  std::string name;                ///< Its name in the file; empty if the form has no names.
  std::vector<std::string> names;  ///< The names of all cameras in the file.
};

/// Reads a camera from a file of corvo or of another tool, whose form is recognized by its content
/// (see camera_formats.h); the same calibration is the same camera in every form. `name` selects
/// one of several cameras; if it is empty, the first is read. Reads at most kMaxCalibrationBytes.
/// Throws corvo::Error, whose message starts with the file, if the form is not known, the file is
/// malformed, has no camera of this name, or if corvo's cameras cannot hold the calibration.
CalibrationFile ReadCalibrationFile(const std::filesystem::path& file,
                                    const std::string& name = "");

/// The same for the content of a calibration file, which messages call `file`.
CalibrationFile ParseCalibration(std::string bytes, const std::filesystem::path& file,
                                 const std::string& name = "");

/// Returns the known forms of calibration files, for messages.
std::string CalibrationForms();

}  // namespace corvo
