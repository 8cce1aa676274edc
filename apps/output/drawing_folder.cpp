// SPDX-License-Identifier: MIT
#include "apps/output/drawing_folder.h"

#include <algorithm>

#include <fmt/format.h>

#include "apps/output/image_file.h"
#include "apps/system/durable_file.h"
#include "orb/error.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

/// Not the name of the manifest of a result: both may be in one folder.
constexpr const char* kDrawingsManifest = ".drawings.manifest.json";

/// Returns whether the file is named like a drawing: digits and ".jpg".
bool IsDrawing(const fs::path& file) {
  const std::string stem = file.stem().string();
  return file.extension() == ".jpg" &&
         std::all_of(stem.begin(), stem.end(), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace

DrawingFolder::DrawingFolder(const fs::path& folder, bool replaces_foreign) : folder_(folder) {
  std::error_code error;
  made_folder_ = fs::create_directories(folder_, error);
  if (error)
    throw Error(fmt::format("{}: cannot be created: {}", folder_.string(), error.message()));
  const fs::path manifest = folder_ / kDrawingsManifest;
  const bool is_foreign = fs::exists(manifest) && !ReadManifest(manifest);
  earlier_ = ReadManifest(manifest).value_or(Manifest());
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) {
    const ManifestFile* listed = earlier_.Find(entry.path().filename().string());
    const bool is_own = listed != nullptr && IsUnchanged(entry.path(), *listed);
    if (replaces_foreign || (!is_foreign && (is_own || !IsDrawing(entry.path())))) continue;
    throw Error(
        fmt::format("{}: not a drawing of an earlier corvo, or changed since; nothing was "
                    "replaced: choose another folder, or use --force",
                    (is_foreign ? manifest : entry.path()).string()));
  }
}

DrawingFolder::~DrawingFolder() {
  std::error_code ignored;
  if (written_.files.empty() && made_folder_) fs::remove(folder_, ignored);
  if (written_.files.empty()) return;
  try {
    WriteFile(folder_ / kDrawingsManifest, ToText(written_));
  } catch (const Error&) {  // The drawings then count as not written by corvo.
  }
}

void DrawingFolder::RemoveEarlier() {
  std::error_code ignored;
  fs::remove(folder_ / kDrawingsManifest, ignored);
  for (const ManifestFile& file : earlier_.files) {
    if (IsUnchanged(folder_ / file.name, file)) fs::remove(folder_ / file.name, ignored);
  }
}

void DrawingFolder::Add(const cv::Mat& drawing, const FrameResult& frame) {
  if (written_.files.empty()) RemoveEarlier();
  const std::string name = fmt::format("{:06}.jpg", frame.index);
  const std::string bytes = EncodeImage(drawing, ".jpg");
  WriteFile(folder_ / name, bytes);
  written_.files.push_back({name, bytes.size(), Crc32(bytes)});
}

}  // namespace corvo
