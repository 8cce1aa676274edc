// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

namespace corvo {

/// The camera files that come with corvo for images of this size, in order of name. Empty where
/// the folder of configurations is not found.
std::vector<std::filesystem::path> FindShippedCameras(int width, int height);

}  // namespace corvo
