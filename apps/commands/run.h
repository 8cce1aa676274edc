// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>

namespace corvo {

/// Adds `corvo run`: images in, trajectory, map and account out. Sets `exit_code` to the Outcome.
void AddRunCommand(CLI::App& app, int& exit_code);

}  // namespace corvo
