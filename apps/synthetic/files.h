// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace corvo::synthetic {

/// Makes a folder and those it lies in. Throws corvo::Error where that cannot be done.
void MakeFolder(const std::filesystem::path& folder);

/// Throws corvo::Error where the file cannot be written.
void WriteText(const std::filesystem::path& file, const std::string& text);

}  // namespace corvo::synthetic
