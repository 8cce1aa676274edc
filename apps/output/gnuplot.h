// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace corvo {

/// Runs gnuplot, without a shell, with the script as standard input and writes its standard output
/// to the file `output`. Returns false and removes the file if gnuplot is missing or fails.
/// Throws corvo::Error if gnuplot succeeds and the file is not whole, as on a full disk.
bool RunGnuplot(const std::string& script, const std::filesystem::path& output);

}  // namespace corvo
