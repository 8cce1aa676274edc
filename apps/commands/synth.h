// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

namespace corvo {

/// Adds the command `corvo synth SCENE -o DIR`, which renders a sequence with exact ground truth.
/// Its callback throws corvo::Error.
void AddSynthCommand(CLI::App& app, int& exit_code);

}  // namespace corvo
