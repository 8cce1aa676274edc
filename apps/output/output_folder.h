// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace corvo {

/// Writes a set of result files all at once or not at all: files are written beside the results of
/// an earlier run and take their place only in Commit. Without Commit nothing is left behind.
class OutputFolder {
 public:
  /// Makes the folder if it is not there. Throws corvo::Error where it cannot be written.
  explicit OutputFolder(const std::filesystem::path& folder);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Where a file that something else writes is to be put until Commit.
  std::filesystem::path Stage(std::string_view name) const { return staging_ / name; }

  /// Throws corvo::Error where the file cannot be written.
  void Write(std::string_view name, std::string_view text) const;

  /// Moves every file into place. Of `names`, those that were not written are removed: they would
  /// be another run's. The last one goes first and comes last: where it is, the set is whole.
  void Commit(const std::vector<std::string>& names);

 private:
  std::filesystem::path folder_;
  std::filesystem::path staging_;
  bool made_folder_ = false;
};

/// Throws corvo::Error where `what` ("the camera") could not be written to a file of that name.
void CheckOutputFile(const std::filesystem::path& file, std::string_view what);

}  // namespace corvo
