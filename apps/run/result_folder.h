// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace corvo {

/// Throws corvo::Error if `folder` is a result folder whose file of that name is not the one that
/// was written with the others: it was changed, or a commit was interrupted. Logs a warning if the
/// result is partial. Accepts a folder without a manifest, and anything that is not a folder.
void CheckResultFile(const std::filesystem::path& folder, const std::string& name);

}  // namespace corvo
