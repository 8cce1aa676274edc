// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "vo/camera/camera_parameters.h"

namespace corvo {

/// Checks the camera that `origin`, a camera file or a dataset, states. Logs a warning for each
/// unusual value and returns the warnings. Throws corvo::Error if a value cannot be right; see
/// CheckPlausible() and UnusualValues().
std::vector<std::string> CheckCamera(const std::filesystem::path& origin,
                                     const CameraParameters& camera);

}  // namespace corvo
