// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace corvo::test {

/// A new folder in the system's folder for temporary files ($TMPDIR), removed with the object. Its
/// name has no random part, so that what a test looks for in a message cannot be in it by chance.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

  /// Writes a file, whose name may have folders in it, and returns its path.
  std::filesystem::path Write(const std::string& name, const std::string& text) const;

  /// Removes everything in the folder.
  void Clear() const;

 private:
  std::filesystem::path path_;
};

/// Writes a file and creates its parent folders.
void WriteText(const std::filesystem::path& file, const std::string& text);

}  // namespace corvo::test
