// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>

namespace corvo {

/// Adds the command `corvo eval`, which evaluates an estimated trajectory against ground truth.
void AddEvalCommand(CLI::App& app);

}  // namespace corvo
