// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

namespace corvo {

/// Returns the path that is `relative` to the folder of the running command: what belongs to the
/// command lies at the same place in the build tree and when installed.
std::filesystem::path PathFromCommand(const std::filesystem::path& relative);

}  // namespace corvo
