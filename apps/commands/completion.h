// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

namespace corvo {

/// Adds `corvo completion SHELL`, which prints a script that completes commands and options, and
/// `corvo manual [COMMAND]`, which prints a manual page.
void AddCompletionCommands(CLI::App& app);

}  // namespace corvo
