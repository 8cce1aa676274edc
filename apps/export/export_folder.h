// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

namespace corvo {

/// A folder that appears as a whole or not at all: it is written beside its final place and moved
/// there by Commit(). Without Commit() nothing is left behind.
class ExportFolder {
 public:
  /// Throws corvo::Error if `folder` exists and is not empty, unless it is an earlier export and
  /// `replaces` is set.
  ExportFolder(const std::filesystem::path& folder, bool replaces);
  ~ExportFolder();
  ExportFolder(const ExportFolder&) = delete;
  ExportFolder& operator=(const ExportFolder&) = delete;

  /// The folder to be written into until Commit().
  const std::filesystem::path& staging() const { return staging_; }

  /// Writes a file, and the folders on its way. Throws corvo::Error if that fails.
  void Write(const std::filesystem::path& name, const std::string& bytes) const;

  /// Moves the folder to its place. `description` goes into its corvo_export.json, by which it is
  /// recognized as an export.
  void Commit(const std::string& description);

 private:
  std::filesystem::path folder_, staging_;
};

}  // namespace corvo
