// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "vo/core/trajectory.h"
#include "vo/io/text_lines.h"

namespace corvo {

// The formats of trajectory_io.h, parsed from the lines of a file; `file` is for messages. All
// throw corvo::Error that starts with "<file>:<line>: ".

/// Parses TUM's format. The unit of the times is that of GuessTimeUnit() for the first row. If
/// `with_gaps` is set, rows with NaN are left out.
PoseSequence ParseTumRows(const std::vector<TextLine>& lines, const std::filesystem::path& file,
                          bool with_gaps = false);

/// Parses KITTI's format of 12 numbers a row, or of the 16 numbers of a 4x4 matrix.
std::vector<SE3> ParseKittiRows(const std::vector<TextLine>& lines,
                                const std::filesystem::path& file);

/// Parses EuRoC's format.
PoseSequence ParseEurocRows(const std::vector<TextLine>& lines, const std::filesystem::path& file);

}  // namespace corvo
