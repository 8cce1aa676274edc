// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace corvo {

/// Writes a set of result files all at once or not at all. Files are staged in a subfolder and
/// replace the results of an earlier run only in Commit(). Without Commit() nothing is left behind.
class OutputFolder {
 public:
  /// Creates the folder if it does not exist. Throws corvo::Error if it cannot be written.
  explicit OutputFolder(const std::filesystem::path& folder);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Returns the path to which a file of that name must be written before Commit().
  std::filesystem::path Stage(std::string_view name) const { return staging_ / name; }

  /// Stages a file with the content `text`. Throws corvo::Error if it cannot be written.
  void Write(std::string_view name, std::string_view text) const;

  /// Returns the names "<prefix><digits><suffix>" of files that are staged or that an earlier run
  /// left in the folder, in order.
  std::vector<std::string> NumberedNames(std::string_view prefix, std::string_view suffix) const;

  /// Moves the files in `names` into place. Files of these names that were not staged are removed,
  /// since they belong to an earlier run. The last file is removed first and moved last, so that
  /// its presence shows that the set is complete.
  void Commit(const std::vector<std::string>& names);

 private:
  std::filesystem::path folder_;
  std::filesystem::path staging_;
  bool made_folder_ = false;
};

/// Throws corvo::Error if `file` is a folder or its folder cannot be written. `what` ("the camera")
/// names its content in the message.
void CheckOutputFile(const std::filesystem::path& file, std::string_view what);

}  // namespace corvo
