// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace corvo {

/// Returns the arguments of the command line, without the program's name, in full: an existing file
/// or folder, or a pattern, in the place of a command stands for `run` with it, with
/// `-o NAME.corvo` unless an output is given, and `--focal auto` unless a camera is given or comes
/// with the dataset. Throws corvo::Error with the nearest command if the first argument is none of
/// these.
std::vector<std::string> ExpandShorthand(const CLI::App& app, std::vector<std::string> arguments);

}  // namespace corvo
