// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>

#include "apps/export/reconstruction.h"
#include "apps/export/run_result.h"
#include "apps/export/undistortion.h"

namespace corvo {

/// Writes the images of a reconstruction into a folder, under their names and in color, with the
/// size of its camera; undistorted if `undistortion` is given. 16-bit images become the 8-bit ones
/// of the run. Image files that need no change are copied. Throws corvo::Error if an image cannot
/// be read or written.
void ExportImages(const RunResult& result, const Reconstruction& reconstruction,
                  const std::optional<Undistortion>& undistortion,
                  const std::filesystem::path& folder);

}  // namespace corvo
