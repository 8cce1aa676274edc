// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace corvo {

/// Runs gnuplot, without a shell, with the script as standard input and writes its standard output
/// to the file `output`, without times of creation. Returns false and removes the file if gnuplot
/// is missing or fails. Throws corvo::Error if gnuplot succeeds and the file is not whole, as on a
/// full disk, or if its extension is not that of a PlotFormat.
bool RunGnuplot(const std::string& script, const std::filesystem::path& output);

}  // namespace corvo
