// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>

namespace corvo {

/// Adds the command `corvo run`, which computes a trajectory and a map from images, and reports on
/// the run. It sets `exit_code` to the Outcome.
void AddRunCommand(CLI::App& app, int& exit_code);

}  // namespace corvo
