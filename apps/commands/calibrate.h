// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>

namespace corvo {

/// Adds the command `corvo calibrate`, which sets `exit_code` when it has run.
void AddCalibrateCommand(CLI::App& app, int& exit_code);

}  // namespace corvo
