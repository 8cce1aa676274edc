// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

namespace corvo {

/// Adds the command `corvo learn IMAGE... -o PATTERN`, which learns the binary tests of descriptors
/// from images. Its callback throws corvo::Error.
void AddLearnCommand(CLI::App& app);

}  // namespace corvo
