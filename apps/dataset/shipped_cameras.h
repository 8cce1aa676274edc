// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

namespace corvo {

/// Returns the camera files that are shipped with corvo for images of this size, sorted by path.
/// Empty if the folder of configurations is not found.
std::vector<std::filesystem::path> FindShippedCameras(int width, int height);

}  // namespace corvo
