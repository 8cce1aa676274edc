// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "vo/core/trajectory.h"

namespace corvo {

/// Writes the posed frames in TUM format. If there are several segments, a comment line marks each.
/// Throws corvo::Error if the file cannot be written.
void WriteTrajectory(const std::filesystem::path& file, const Trajectory& trajectory);

}  // namespace corvo
