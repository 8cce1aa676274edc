// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace corvo {

/// Sets the folder of the shipped configurations of a program other than the command, which finds
/// them at their place relative to itself.
void SetConfigFolder(const std::filesystem::path& folder);

/// Returns the names of the cameras that are shipped with corvo, sorted. Empty if the folder of
/// configurations is not found.
std::vector<std::string> ShippedCameraNames();

/// Like ShippedCameraNames(), but only of cameras with images of this size.
std::vector<std::string> ShippedCameraNames(int width, int height);

/// Returns the file of a shipped camera, "tum_fr1" or "tum_fr1.yaml"; an empty path if there is
/// none of this name.
std::filesystem::path ShippedCameraFile(const std::string& name);

}  // namespace corvo
