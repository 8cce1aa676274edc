// SPDX-License-Identifier: MIT
#include "apps/synthetic/files.h"

#include <fstream>
#include <system_error>

#include <fmt/format.h>

#include "orb/error.h"

namespace corvo::synthetic {

void MakeFolder(const std::filesystem::path& folder) {
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  if (code) throw Error(fmt::format("{}: {}", folder.string(), code.message()));
}

void WriteText(const std::filesystem::path& file, const std::string& text) {
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) throw Error(fmt::format("{}: cannot be written", file.string()));
}

}  // namespace corvo::synthetic
