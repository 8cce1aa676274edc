// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

namespace corvo {

/// `corvo learn IMAGE... -o PATTERN`: the binary tests of descriptors, learned from images. Its
/// callback throws corvo::Error.
void AddLearnCommand(CLI::App& app);

}  // namespace corvo
