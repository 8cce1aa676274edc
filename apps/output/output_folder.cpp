// SPDX-License-Identifier: MIT
#include "apps/output/output_folder.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "apps/system/durable_file.h"
#include "apps/system/interruption.h"
#include "orb/error.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

/// Returns whether a name is "<prefix><digits><suffix>".
bool IsNumbered(std::string_view name, std::string_view prefix, std::string_view suffix) {
  if (!name.starts_with(prefix) || !name.ends_with(suffix)) return false;
  if (name.size() <= prefix.size() + suffix.size()) return false;
  name.remove_prefix(prefix.size());
  name.remove_suffix(suffix.size());
  return std::all_of(name.begin(), name.end(), [](char c) { return c >= '0' && c <= '9'; });
}

bool Exists(const fs::path& file) { return fs::exists(fs::symlink_status(file)); }

/// Returns whether a file does not exist or is the one that the manifest lists.
bool IsOwn(const fs::path& file, const std::optional<Manifest>& manifest) {
  if (!Exists(file)) return true;
  const ManifestFile* listed = manifest ? manifest->Find(file.filename().string()) : nullptr;
  return listed != nullptr && IsUnchanged(file, *listed);
}

/// Returns the entries of a result folder that are not its own; the folder itself if it is no
/// result folder.
std::vector<fs::path> ForeignEntries(const fs::path& folder) {
  const auto manifest = ReadManifest(folder / kManifestName);
  if (!manifest) return {folder};
  std::vector<fs::path> foreign;
  for (const std::string& name : ListNames(folder)) {
    if (name != kManifestName && !IsOwn(folder / name, manifest)) foreign.push_back(folder / name);
  }
  return foreign;
}

std::string NamesText(std::vector<std::string> names) {
  constexpr std::size_t kMaxNames = 5;
  const std::size_t num_more = names.size() - std::min(names.size(), kMaxNames);
  names.resize(names.size() - num_more);
  const std::string text = fmt::format("{}", fmt::join(names, ", "));
  return num_more == 0 ? text : fmt::format("{} and {} more", text, num_more);
}

}  // namespace

OutputPlan PlanOfFile(const fs::path& file, std::vector<std::string> others,
                      bool replaces_foreign) {
  if (fs::is_directory(file) || !file.has_filename()) {
    throw Error(fmt::format("{}: is a folder; the output is written to a file", file.string()));
  }
  const std::string name = file.filename().string();
  others.push_back(name);
  return {std::move(others),
          {},
          {},
          {},
          replaces_foreign,
          fmt::format(".{}.manifest.json", name),
          fmt::format(".{}.unfinished", name)};
}

OutputFolder::OutputFolder(const fs::path& folder, OutputPlan plan)
    : plan_(std::move(plan)),
      work_(folder, plan_.work_folder),
      places_{folder, work_.path() / "new", work_.path() / "old", plan_.manifest} {
  // A result that was staged in full is moved in to the end; anything else is discarded.
  if (ReadManifest(places_.staged / places_.manifest)) {
    CheckUnobstructed(StagedNames(places_));
    MoveStagedIn();
  }
  for (const fs::path& left_over : {places_.staged, places_.aside, work_.path() / "checkpoint"}) {
    if (!RemoveTree(left_over)) {
      throw Error(fmt::format("{}: cannot be removed", left_over.string()));
    }
  }
  std::vector<std::string> names = PlannedNames();
  names.push_back(places_.manifest);
  CheckUnobstructed(std::move(names));
  CheckCheckpoint();
}

fs::path OutputFolder::Stage(std::string_view name) const {
  std::error_code ignored;  // Writing the file reports it.
  fs::create_directories(places_.staged, ignored);
  return places_.staged / name;
}

void OutputFolder::Write(std::string_view name, std::string_view text) const {
  WriteFile(Stage(name), text);
}

void OutputFolder::Discard() const { RemoveTree(places_.staged); }

std::vector<std::string> OutputFolder::PlannedNames() const {
  std::vector<std::string> names = plan_.names;
  for (const std::string& name : ListNames(places_.folder)) {
    if (IsPlanned(name) && !std::ranges::count(names, name)) names.push_back(name);
  }
  return names;
}

bool OutputFolder::IsPlanned(const std::string& name) const {
  const bool has_numbered = !plan_.numbered_prefix.empty() || !plan_.numbered_suffix.empty();
  return std::ranges::count(plan_.names, name) > 0 ||
         (has_numbered && IsNumbered(name, plan_.numbered_prefix, plan_.numbered_suffix));
}

void OutputFolder::CheckUnobstructed(std::vector<std::string> names) const {
  const auto manifest = EarlierManifest();
  std::erase_if(names, [&](const std::string& name) {
    const fs::path file = places_.folder / name;
    const bool is_folder = fs::is_directory(fs::symlink_status(file));
    const bool is_own_manifest = name == places_.manifest && manifest;
    return is_own_manifest || IsOwn(file, manifest) || (plan_.replaces_foreign && !is_folder);
  });
  ThrowIfForeign(std::move(names));
}

void OutputFolder::CheckCheckpoint() const {
  if (plan_.checkpoint.empty() || plan_.replaces_foreign || !Exists(checkpoint())) return;
  std::vector<std::string> names;
  for (const fs::path& entry : ForeignEntries(checkpoint())) {
    names.push_back(entry.lexically_relative(places_.folder).string());
  }
  ThrowIfForeign(std::move(names));
}

void OutputFolder::ThrowIfForeign(std::vector<std::string> names) const {
  if (names.empty()) return;
  throw Error(
      fmt::format("{}: {}: not written by an earlier corvo, or changed since; nothing was "
                  "replaced: choose another output, or use --force",
                  places_.folder.string(), NamesText(std::move(names))));
}

std::optional<Manifest> OutputFolder::EarlierManifest() const {
  auto manifest = ReadManifest(places_.folder / places_.manifest);
  return manifest ? manifest : ReadManifest(places_.aside / places_.manifest);
}

void OutputFolder::Seal(const fs::path& staged, Manifest manifest) const {
  for (const std::string& name : ListNames(staged)) {
    Flush(staged / name);
    manifest.files.push_back(Describe(staged / name));
  }
  std::ranges::sort(manifest.files, {}, &ManifestFile::name);
  WriteFile(staged / places_.manifest, ToText(manifest));
  Flush(staged / places_.manifest);
  Flush(staged);
}

void OutputFolder::Commit(bool is_complete) {
  Manifest manifest{is_complete, {}};
  CheckUnobstructed(StagedNames(places_));
  // Files of another command's result in this folder stay.
  if (const auto earlier = ReadManifest(places_.folder / places_.manifest)) {
    for (const ManifestFile& file : earlier->files) {
      if (!IsPlanned(file.name)) manifest.files.push_back(file);
    }
  }
  Seal(places_.staged, std::move(manifest));
  MoveStagedIn();
  if (!plan_.checkpoint.empty()) RemoveTree(checkpoint());
}

void OutputFolder::MoveStagedIn() {
  const InterruptionDeferral deferral;
  try {
    MoveIn(places_, is_torn_);
  } catch (const std::exception&) {
    if (is_torn_) work_.Keep();
    throw;
  }
}

fs::path OutputFolder::StageCheckpoint(std::string_view name) const {
  const fs::path folder = work_.path() / "checkpoint";
  std::error_code ignored;
  fs::create_directories(folder, ignored);
  return folder / name;
}

void OutputFolder::SaveCheckpoint() const {
  const fs::path folder = work_.path() / "checkpoint";
  Seal(folder, {false, {}});
  ReplaceFolder(folder, checkpoint());
  Flush(places_.folder);
}

void OutputFolder::CommitAsCheckpoint(bool is_complete) const {
  fs::remove(places_.staged / places_.manifest);
  Seal(places_.staged, {is_complete, {}});
  ReplaceFolder(places_.staged, checkpoint());
  Flush(places_.folder);
}

bool OutputFolder::HoldsCompleteResult() const {
  const auto manifest = ReadManifest(places_.folder / places_.manifest);
  return manifest && manifest->is_complete;
}

}  // namespace corvo
