// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

namespace corvo {

/// Adds `corvo export`.
void AddExportCommand(CLI::App& app);

}  // namespace corvo
