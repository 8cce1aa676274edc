// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string_view>

namespace corvo {

/// A hidden subfolder for unfinished files, which one process at a time has. It is removed with the
/// object, as is the folder around it if that was created for it and is empty.
class WorkFolder {
 public:
  /// Creates and locks `folder`/`name`. Throws corvo::Error if it cannot be written or if another
  /// process has it. The system releases the lock when the process ends, however it ends.
  WorkFolder(const std::filesystem::path& folder, std::string_view name);
  ~WorkFolder();
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Keeps the folder on disk when the object is destroyed.
  void Keep() { is_kept_ = true; }

 private:
  void Lock();

  std::filesystem::path around_;
  std::filesystem::path path_;
  bool made_around_ = false;
  bool is_kept_ = false;
  int lock_ = -1;  ///< The open lock file.
};

}  // namespace corvo
