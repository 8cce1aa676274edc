// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace corvo {

/// Returns the names of an option: "-o", "--output".
std::vector<std::string> OptionNames(const CLI::Option& option);

/// Returns whether an option is followed by a value.
bool TakesValue(const CLI::Option& option);

/// Returns a script that completes the commands and options of a program, the choices of options
/// and arguments, and names of files, in a shell: "bash", "zsh" or "fish".
std::string CompletionScript(const CLI::App& app, const std::string& shell);

}  // namespace corvo
