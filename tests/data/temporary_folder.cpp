// SPDX-License-Identifier: MIT
#include "tests/data/temporary_folder.h"

#include <unistd.h>

#include <atomic>
#include <fstream>
#include <system_error>

namespace corvo::test {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  static std::atomic<int> num_folders = 0;
  // A process that was killed may have left a folder of the same number.
  do {
    path_ = fs::temp_directory_path() /
            ("corvo_test_" + std::to_string(::getpid()) + "_" + std::to_string(num_folders++));
  } while (!fs::create_directory(path_));
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

fs::path TemporaryFolder::Write(const std::string& name, const std::string& text) const {
  WriteText(path_ / name, text);
  return path_ / name;
}

void TemporaryFolder::Clear() const {
  for (const fs::directory_entry& entry : fs::directory_iterator(path_)) {
    fs::remove_all(entry.path());
  }
}

void WriteText(const fs::path& file, const std::string& text) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
}

}  // namespace corvo::test
