// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>

namespace corvo {

/// Adds `corvo config`: prints the options, the defaults or those of a file.
void AddConfigCommand(CLI::App& app);

}  // namespace corvo
