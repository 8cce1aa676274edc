// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace corvo::test {

/// Returns the root of the project's sources.
std::filesystem::path SourceDir();

/// Returns the path of a file or folder of the test data: below $CORVO_DATA or, if that is unset or
/// empty, below `../shared/data` relative to the project's root. It may not exist.
std::filesystem::path DataPath(const std::filesystem::path& relative);

}  // namespace corvo::test
