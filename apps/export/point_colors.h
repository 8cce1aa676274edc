// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "apps/dataset/gray_levels.h"
#include "apps/export/reconstruction.h"

namespace corvo {

/// Gives each point its color in the first image that observes it. The images are files in `folder`
/// by their names, perhaps larger or smaller than the camera's and of 16 bits, which `levels`
/// converts; points of images that cannot be read keep their color. Observations are those of the
/// images as they were taken, not undistorted.
void ColorPoints(const std::filesystem::path& folder, const GrayLevels& levels,
                 Reconstruction& reconstruction);

}  // namespace corvo
