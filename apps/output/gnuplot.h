// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace corvo {

/// Feeds a script to gnuplot and keeps what it prints as `output`. No shell and no path takes part
/// in the script. False, with no file left, where gnuplot is missing or fails.
bool RunGnuplot(const std::string& script, const std::filesystem::path& output);

}  // namespace corvo
