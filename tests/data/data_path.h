// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace corvo::test {

/// Root of the project's sources.
std::filesystem::path SourceDir();

/// A file or folder of the test data: below $CORVO_DATA, or `../shared/data` seen from the
/// project's root. It may not exist.
std::filesystem::path DataPath(const std::filesystem::path& relative);

}  // namespace corvo::test
