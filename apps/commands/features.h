// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/CLI.hpp>

namespace corvo {

/// `corvo features IMAGE... -o DIR`: the features of images, drawn and as tables. Its callback
/// throws corvo::Error.
void AddFeaturesCommand(CLI::App& app);

}  // namespace corvo
