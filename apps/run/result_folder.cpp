// SPDX-License-Identifier: MIT
#include "apps/run/result_folder.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "apps/output/manifest.h"
#include "apps/output/output_folder.h"
#include "apps/run/run_results.h"
#include "orb/error.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void ThrowWithoutManifest(const fs::path& folder, const std::string& name) {
  if (fs::exists(folder / OutputPlan().work_folder / "new" / kManifestName)) {
    throw Error(
        fmt::format("{}: the files of two results are mixed, because a run was stopped while it "
                    "put its files in place; the next run into this folder finishes that",
                    folder.string()));
  }
  const fs::path checkpoint = folder / kCheckpointFolder;
  const std::string hint = fs::exists(checkpoint / name)
                               ? fmt::format("; an unfinished run left {}", checkpoint.string())
                               : "";
  throw Error(fmt::format("{}: no such file{}", (folder / name).string(), hint));
}

}  // namespace

void CheckResultFile(const fs::path& folder, const std::string& name) {
  if (!fs::is_directory(folder)) return;
  const auto manifest = ReadManifest(folder / kManifestName);
  const bool is_moving = fs::exists(folder / OutputPlan().work_folder / "new" / kManifestName);
  if (!manifest && (is_moving || !fs::exists(folder / name))) ThrowWithoutManifest(folder, name);
  if (!manifest) return;
  const ManifestFile* file = manifest->Find(name);
  if (file == nullptr || !IsUnchanged(folder / name, *file)) {
    throw Error(
        fmt::format("{}: is not the file that the run wrote, according to {}; to use it as it is, "
                    "give the file instead of its folder",
                    (folder / name).string(), kManifestName));
  }
  if (!manifest->is_complete) {
    spdlog::warn("{}: the result is partial: its run ended early (see ended_by in summary.json)",
                 folder.string());
  }
}

}  // namespace corvo
