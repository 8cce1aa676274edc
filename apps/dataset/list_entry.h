// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace corvo {

/// Returns the path of a file that a list of a dataset names, relative to `folder`. Throws
/// corvo::Error, whose message starts with `where` and holds the name, if the name is empty, is
/// absolute or leaves the folder ("../"): a dataset must not make other files be read.
std::filesystem::path EntryPath(const std::filesystem::path& folder, const std::string& name,
                                const std::string& where);

}  // namespace corvo
