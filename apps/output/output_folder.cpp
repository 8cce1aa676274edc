// SPDX-License-Identifier: MIT
#include "apps/output/output_folder.h"

#include <algorithm>
#include <fstream>
#include <set>

#include <fmt/format.h>

#include "orb/error.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStagingName = ".corvo-unfinished";

/// Returns whether a name is "<prefix><digits><suffix>".
bool IsNumbered(std::string_view name, std::string_view prefix, std::string_view suffix) {
  if (!name.starts_with(prefix) || !name.ends_with(suffix)) return false;
  if (name.size() <= prefix.size() + suffix.size()) return false;
  name.remove_prefix(prefix.size());
  name.remove_suffix(suffix.size());
  return std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& folder)
    : folder_(folder), staging_(folder / kStagingName) {
  if (fs::exists(folder_) && !fs::is_directory(folder_)) {
    throw Error(fmt::format("{}: the output folder is a file", folder_.string()));
  }
  std::error_code error;
  made_folder_ = fs::create_directories(folder_, error);
  if (!error) fs::remove_all(staging_, error);
  if (!error) fs::create_directory(staging_, error);
  if (error) {
    throw Error(fmt::format("{}: cannot be written: {}", folder_.string(), error.message()));
  }
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  fs::remove_all(staging_, ignored);
  if (made_folder_) fs::remove(folder_, ignored);  // Fails unless the folder is empty.
}

void OutputFolder::Write(std::string_view name, std::string_view text) const {
  std::ofstream stream(Stage(name), std::ios::binary);
  stream << text;
  stream.close();
  if (!stream) throw Error(fmt::format("{}: cannot be written", (folder_ / name).string()));
}

std::vector<std::string> OutputFolder::NumberedNames(std::string_view prefix,
                                                     std::string_view suffix) const {
  std::set<std::string> names;
  for (const fs::path& folder : {folder_, staging_}) {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      if (entry.is_regular_file() && IsNumbered(name, prefix, suffix)) names.insert(name);
    }
  }
  return {names.begin(), names.end()};
}

void OutputFolder::Commit(const std::vector<std::string>& names) {
  std::error_code error;
  if (!names.empty()) fs::remove(folder_ / names.back(), error);
  for (const std::string& name : names) {
    if (fs::exists(Stage(name))) {
      fs::rename(Stage(name), folder_ / name, error);
    } else {
      fs::remove(folder_ / name, error);
    }
    if (!error) continue;
    throw Error(fmt::format("{}: {}", (folder_ / name).string(), error.message()));
  }
}

void CheckOutputFile(const fs::path& file, std::string_view what) {
  if (fs::is_directory(file) || !file.has_filename()) {
    throw Error(fmt::format("{}: is a folder; {} is written to a file", file.string(), what));
  }
  const OutputFolder probe(fs::absolute(file).parent_path());
}

}  // namespace corvo
