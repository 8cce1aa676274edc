// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

namespace corvo {

/// `corvo synth SCENE -o DIR`: renders a sequence with exact ground truth. Its callback throws
/// corvo::Error.
void AddSynthCommand(CLI::App& app);

}  // namespace corvo
