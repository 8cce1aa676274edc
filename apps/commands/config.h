// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>

namespace corvo {

/// Adds the command `corvo config`, which prints the default options or those of a file.
void AddConfigCommand(CLI::App& app);

}  // namespace corvo
