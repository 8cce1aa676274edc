// SPDX-License-Identifier: MIT
#include "apps/export/export_folder.h"

#include <fmt/format.h>

#include "apps/system/durable_file.h"
#include "orb/error.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMarker = "corvo_export.json";

void CheckFree(const fs::path& folder, bool replaces) {
  if (!fs::exists(folder) || (fs::is_directory(folder) && fs::is_empty(folder))) return;
  if (!fs::exists(folder / kMarker)) {
    throw Error(fmt::format("{}: exists and is not an export of corvo; choose another folder",
                            folder.string()));
  }
  if (!replaces) {
    throw Error(
        fmt::format("{}: holds an earlier export, perhaps with files that other programs "
                    "have added; choose another folder, or replace all of it with --force",
                    folder.string()));
  }
}

}  // namespace

ExportFolder::ExportFolder(const fs::path& folder, bool replaces)
    : folder_(fs::absolute(folder).lexically_normal()) {
  if (folder_.filename().empty()) folder_ = folder_.parent_path();
  CheckFree(folder_, replaces);
  staging_ =
      folder_.parent_path() / fmt::format(".{}.corvo-unfinished", folder_.filename().string());
  RemoveTree(staging_);
  std::error_code error;
  fs::create_directories(staging_, error);
  if (error) throw Error(fmt::format("{}: {}", staging_.string(), error.message()));
}

ExportFolder::~ExportFolder() { RemoveTree(staging_); }

void ExportFolder::Write(const fs::path& name, const std::string& bytes) const {
  const fs::path file = staging_ / name;
  fs::create_directories(file.parent_path());
  WriteFile(file, bytes);
}

void ExportFolder::Commit(const std::string& description) {
  Write(kMarker, description);
  ReplaceFolder(staging_, folder_);
}

}  // namespace corvo
