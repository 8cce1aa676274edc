// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

namespace corvo {

/// Adds the command `corvo features IMAGE... -o DIR`, which extracts the features of images and
/// writes them as drawings and tables. Its callback throws corvo::Error.
void AddFeaturesCommand(CLI::App& app);

}  // namespace corvo
