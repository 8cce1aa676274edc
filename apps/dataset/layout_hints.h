// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace corvo {

/// Returns what a folder lacks of the layouts that some of its files belong to, for the end of an
/// error message; empty if there are no such files.
std::string LayoutHints(const std::filesystem::path& folder);

}  // namespace corvo
