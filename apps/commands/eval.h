// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>

namespace corvo {

/// Adds `corvo eval`: how far an estimated trajectory is from the truth.
void AddEvalCommand(CLI::App& app);

}  // namespace corvo
