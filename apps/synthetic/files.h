// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace corvo::synthetic {

/// Creates a folder and its parent folders. Throws corvo::Error if they cannot be created.
void MakeFolder(const std::filesystem::path& folder);

/// Writes a text file. Throws corvo::Error if it cannot be written.
void WriteText(const std::filesystem::path& file, const std::string& text);

}  // namespace corvo::synthetic
