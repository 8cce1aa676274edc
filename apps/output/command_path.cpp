// SPDX-License-Identifier: MIT
#include "apps/output/command_path.h"

namespace corvo {

std::filesystem::path PathFromCommand(const std::filesystem::path& relative) {
  std::error_code none;
  const std::filesystem::path command = std::filesystem::read_symlink("/proc/self/exe", none);
  return (command.parent_path() / relative).lexically_normal();
}

}  // namespace corvo
