// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace corvo::fuzz {

/// Writes `text` to a file of this process and returns its path. Every call writes the same file.
std::filesystem::path WriteScratchFile(const std::string& text);

}  // namespace corvo::fuzz
