// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

namespace corvo {

/// Adds the command `corvo match A B -o DIR`, which matches the features of two images and writes
/// the matches as a drawing and a table. Its callback throws corvo::Error.
void AddMatchCommand(CLI::App& app);

}  // namespace corvo
