// SPDX-License-Identifier: MIT
#include "apps/dataset/list_entry.h"

#include <fmt/format.h>

#include "orb/error.h"

namespace corvo {

namespace fs = std::filesystem;

fs::path EntryPath(const fs::path& folder, const std::string& name, const std::string& where) {
  // Most names, of which a list may have a million, are seen to be inside without parsing them.
  const bool is_plain =
      !name.empty() && name.front() != '/' && name.find("..") == std::string::npos;
  if (is_plain) return folder / name;
  const fs::path entry = fs::path(name).lexically_normal();
  const bool leaves = entry.is_absolute() || (!entry.empty() && *entry.begin() == "..");
  if (!entry.empty() && !leaves) return folder / name;
  throw Error(fmt::format("{}'{}' is not the name of a file inside {}", where, name,
                          folder.empty() ? "the folder" : folder.string()));
}

}  // namespace corvo
