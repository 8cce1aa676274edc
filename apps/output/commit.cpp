// SPDX-License-Identifier: MIT
#include "apps/output/commit.h"

#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/output/error_text.h"
#include "apps/output/manifest.h"
#include "apps/system/durable_file.h"
#include "orb/error.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

/// Renames files and can undo it.
class Moves {
 public:
  void Do(const fs::path& from, const fs::path& to) {
    done_.emplace_back(from, to);  // Memory may run out here, but not after the move.
    try {
      Move(from, to);
    } catch (const std::exception&) {
      done_.pop_back();
      throw;
    }
  }

  void Undo() {
    for (; !done_.empty(); done_.pop_back()) Move(done_.back().second, done_.back().first);
  }

 private:
  std::vector<std::pair<fs::path, fs::path>> done_;
};

void SetAside(const std::string& name, const ResultPlaces& places, Moves& moves) {
  const fs::path file = places.folder / name;
  const fs::file_status status = fs::symlink_status(file);
  if (!fs::exists(status)) return;
  if (fs::is_directory(status)) {
    throw Error(fmt::format("{}: cannot be written: a folder has this name", file.string()));
  }
  moves.Do(file, places.aside / name);
}

/// Sets aside the earlier result. Files with names of staged ones are earlier ones, also when an
/// interrupted commit is continued.
void SetAsideEarlier(const ResultPlaces& places, Moves& moves) {
  const auto fresh = ReadManifest(places.staged / places.manifest);
  if (!fresh) throw Error(fmt::format("{}: no staged result", places.staged.string()));
  SetAside(places.manifest, places, moves);
  if (const auto earlier = ReadManifest(places.aside / places.manifest)) {
    for (const ManifestFile& file : earlier->files) {
      const bool is_stale = fresh->Find(file.name) == nullptr;
      if (is_stale && IsUnchanged(places.folder / file.name, file)) {
        SetAside(file.name, places, moves);
      }
    }
  }
  for (const std::string& name : StagedNames(places)) SetAside(name, places, moves);
}

}  // namespace

std::vector<std::string> StagedNames(const ResultPlaces& places) {
  std::vector<std::string> names = ListNames(places.staged);
  std::erase(names, places.manifest);
  return names;
}

void MoveIn(const ResultPlaces& places, bool& is_torn) {
  Moves moves;
  try {
    fs::create_directories(places.aside);
    SetAsideEarlier(places, moves);
    Flush(places.aside);
    for (const std::string& name : StagedNames(places)) {
      moves.Do(places.staged / name, places.folder / name);
    }
    Flush(places.folder);
    moves.Do(places.staged / places.manifest, places.folder / places.manifest);
    Flush(places.folder);
  } catch (const std::exception& error) {
    is_torn = true;
    moves.Undo();
    is_torn = false;
    throw Error(ErrorText(error));
  }
}

}  // namespace corvo
