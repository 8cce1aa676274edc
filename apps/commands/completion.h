// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <CLI/CLI.hpp>

namespace corvo {

/// Returns a script that completes the commands and options of the program in a shell: "bash",
/// "zsh" or "fish".
std::string CompletionScript(const CLI::App& app, const std::string& shell);

/// Returns the manual page, in the format of man(7), of the program or of one of its commands.
std::string ManualPage(const CLI::App& app);

/// Adds `corvo completion SHELL` and `corvo manual [COMMAND]`, which print them.
void AddCompletionCommands(CLI::App& app);

}  // namespace corvo
