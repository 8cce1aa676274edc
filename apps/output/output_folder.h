// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/output/commit.h"
#include "apps/output/manifest.h"
#include "apps/system/work_folder.h"

namespace corvo {

/// The files that a command may write into a folder.
struct OutputPlan {
  std::vector<std::string> names;
  /// Files "<prefix><digits><suffix>", unless both are empty.
  std::string numbered_prefix;
  std::string numbered_suffix;
  /// Name of the subfolder for the result of an unfinished run; empty if there is none.
  std::string checkpoint;
  bool replaces_foreign = false;  ///< Whether files that are not corvo's are replaced (--force).
  std::string manifest = kManifestName;
  std::string work_folder = ".corvo-unfinished";
};

/// Returns the plan of a command that writes the file that the user named, and further files beside
/// it. Its manifest is hidden.
OutputPlan PlanOfFile(const std::filesystem::path& file, std::vector<std::string> others,
                      bool replaces_foreign);

/// Writes a set of result files all at once or not at all. Files are staged in a hidden subfolder
/// and replace the results of an earlier run only in Commit(). Without Commit() nothing is left
/// behind. Only files that the manifest of an earlier result lists are replaced or removed.
class OutputFolder {
 public:
  /// Creates the folder if it does not exist, and finishes a commit of an earlier process that was
  /// interrupted. Throws corvo::Error if the folder cannot be written, if another process writes
  /// into it, or if it holds files of planned names that are not corvo's or have been changed.
  OutputFolder(const std::filesystem::path& folder, OutputPlan plan);

  /// Returns the path to which a file of that name must be written before Commit().
  std::filesystem::path Stage(std::string_view name) const;
  /// Stages a file with the content `text`. Throws corvo::Error if it cannot be written.
  void Write(std::string_view name, std::string_view text) const;

  /// Removes the staged files.
  void Discard() const;

  /// Moves the staged files into place, removes those of an earlier result that were not staged,
  /// and removes the checkpoint. If it throws corvo::Error, the folder holds the earlier result.
  void Commit(bool is_complete = true);

  /// Returns the path to which a file of the checkpoint must be written before SaveCheckpoint().
  std::filesystem::path StageCheckpoint(std::string_view name) const;
  /// Replaces the checkpoint by the files that were staged for it.
  void SaveCheckpoint() const;
  /// Makes the result files that were staged for Commit() the checkpoint.
  void CommitAsCheckpoint(bool is_complete) const;

  /// Returns whether the folder holds a complete result.
  bool HoldsCompleteResult() const;
  /// Returns whether Commit() has left old and new files mixed, because undoing it failed, too. The
  /// next process that opens the folder finishes the commit.
  bool is_torn() const { return is_torn_; }
  std::filesystem::path checkpoint() const { return places_.folder / plan_.checkpoint; }

 private:
  /// Throws corvo::Error if files of these names are not corvo's.
  void CheckUnobstructed(std::vector<std::string> names) const;
  void CheckCheckpoint() const;
  void ThrowIfForeign(std::vector<std::string> names) const;
  /// Returns the manifest of the earlier result, also while that is set aside.
  std::optional<Manifest> EarlierManifest() const;
  /// Returns the planned names, with those of numbered files that the folder holds.
  std::vector<std::string> PlannedNames() const;
  bool IsPlanned(const std::string& name) const;
  /// Completes a folder of staged files by their manifest.
  void Seal(const std::filesystem::path& staged, Manifest manifest) const;
  void MoveStagedIn();

  OutputPlan plan_;
  WorkFolder work_;
  ResultPlaces places_;
  bool is_torn_ = false;
};

}  // namespace corvo
