// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

namespace corvo {

/// `corvo match A B -o DIR`: the matches between two images, drawn and as a table. Its callback
/// throws corvo::Error.
void AddMatchCommand(CLI::App& app);

}  // namespace corvo
