// SPDX-License-Identifier: MIT
#include "apps/system/work_folder.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

#include "apps/system/durable_file.h"
#include "orb/error.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

/// Returns whether the open file is still the one with this name.
bool IsFile(int descriptor, const fs::path& file) {
  struct stat opened {};
  struct stat named {};
  return fstat(descriptor, &opened) == 0 && stat(file.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

}  // namespace

WorkFolder::WorkFolder(const fs::path& folder, std::string_view name)
    : around_(folder), path_(folder / name) {
  if (fs::exists(folder) && !fs::is_directory(folder)) {
    throw Error(fmt::format("{}: the output folder is a file", folder.string()));
  }
  std::error_code error;
  made_around_ = fs::create_directories(folder, error);
  if (error) {
    throw Error(fmt::format("{}: cannot be written: {}", folder.string(), error.message()));
  }
  Lock();
}

void WorkFolder::Lock() {
  const fs::path file = path_ / "lock";
  while (!IsFile(lock_, file)) {  // The process that had the lock may remove its file meanwhile.
    if (lock_ >= 0) close(lock_);
    std::error_code ignored;
    fs::create_directory(path_, ignored);
    lock_ = open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (lock_ < 0 && errno == ENOENT && fs::exists(around_)) continue;
    if (lock_ < 0) {
      throw Error(fmt::format("{}: cannot be written: {}", around_.string(), std::strerror(errno)));
    }
    // File systems without locks answer with another error and get none.
    if (flock(lock_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) continue;
    close(lock_);
    throw Error(fmt::format("{}: another corvo is writing into this folder", around_.string()));
  }
}

WorkFolder::~WorkFolder() {
  if (!is_kept_) RemoveTree(path_);
  std::error_code ignored;
  if (made_around_) fs::remove(around_, ignored);  // Fails unless the folder is empty.
  close(lock_);
}

}  // namespace corvo
