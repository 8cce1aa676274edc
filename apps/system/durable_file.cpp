// SPDX-License-Identifier: MIT
#include "apps/system/durable_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include <dirent.h>
#include <fcntl.h>
#include <ftw.h>
#include <stdio.h>
#include <unistd.h>

#include <fmt/format.h>

#include "orb/error.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void Fail(const fs::path& file, int error) {
  throw Error(fmt::format("{}: cannot be written: {}", file.string(), std::strerror(error)));
}

/// An open file. Its destructor ignores errors.
class Descriptor {
 public:
  Descriptor(const fs::path& file, int flags) : number_(open(file.c_str(), flags, 0666)) {
    if (number_ < 0) Fail(file, errno);
  }
  ~Descriptor() { close(number_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }

 private:
  int number_;
};

struct CloseFolder {
  void operator()(DIR* folder) const { closedir(folder); }
};

/// Exchanges two folders. Returns false if the system cannot.
bool Exchange(const fs::path& a, const fs::path& b) {
#ifdef RENAME_EXCHANGE
  return renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0;
#else
  static_cast<void>(a), static_cast<void>(b);
  return false;
#endif
}

}  // namespace

void WriteFile(const fs::path& file, std::string_view content) {
  const Descriptor descriptor(file, O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC);
  while (!content.empty()) {
    const ssize_t count = write(descriptor.number(), content.data(), content.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) Fail(file, errno);
    content.remove_prefix(static_cast<std::size_t>(count));
  }
}

void Flush(const fs::path& file) {
  const Descriptor descriptor(file, O_RDONLY | O_CLOEXEC);
  // Some file systems cannot flush folders and answer EINVAL.
  if (fsync(descriptor.number()) != 0 && errno != EINVAL) Fail(file, errno);
}

std::vector<std::string> ListNames(const fs::path& folder) {
  const std::unique_ptr<DIR, CloseFolder> opened(opendir(folder.c_str()));
  if (!opened && errno == ENOENT) return {};
  std::vector<std::string> names;
  if (opened) errno = 0;
  while (const dirent* const entry = opened ? readdir(opened.get()) : nullptr) {
    const std::string_view name = entry->d_name;
    if (name != "." && name != "..") names.emplace_back(name);
    errno = 0;
  }
  if (errno == 0) return names;
  throw Error(fmt::format("{}: cannot be read: {}", folder.string(), std::strerror(errno)));
}

bool RemoveTree(const fs::path& path) noexcept {
  constexpr int kMaxDescriptors = 16;
  const auto remove_entry = [](const char* entry, const struct stat*, int, FTW*) {
    return std::remove(entry);
  };
  return nftw(path.c_str(), remove_entry, kMaxDescriptors, FTW_DEPTH | FTW_PHYS) == 0 ||
         errno == ENOENT;
}

void Move(const fs::path& from, const fs::path& to) {
  if (rename(from.c_str(), to.c_str()) != 0) Fail(to, errno);
}

void ReplaceFolder(const fs::path& from, const fs::path& to) {
  if (!fs::exists(fs::symlink_status(to))) return Move(from, to);
  if (!Exchange(from, to)) {
    fs::path aside = from;
    aside += ".replaced";
    Move(to, aside);
    Move(from, to);
    Move(aside, from);
  }
  RemoveTree(from);
}

}  // namespace corvo
