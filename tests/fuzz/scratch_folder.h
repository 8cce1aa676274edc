// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace corvo::fuzz {

/// A folder in the system's folder for temporary files ($TMPDIR), removed with the object.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

  /// Writes a file, whose name may have folders in it, and returns its path.
  std::filesystem::path Write(const std::string& name, const std::string& text) const;

  /// Removes everything in the folder.
  void Clear() const;

 private:
  std::filesystem::path path_;
};

/// Writes `text` to a file of this process and returns its path. Every call writes the same file.
std::filesystem::path WriteScratchFile(const std::string& text);

}  // namespace corvo::fuzz
