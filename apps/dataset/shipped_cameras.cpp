// SPDX-License-Identifier: MIT
#include "apps/dataset/shipped_cameras.h"

#include <algorithm>
#include <optional>

#include "apps/output/command_path.h"
#include "orb/error.h"
#include "vo/io/config.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

/// Returns std::nullopt for an options file.
std::optional<Camera> FindCamera(const fs::path& file) {
  try {
    return ReadCameraFile(file).camera;
  } catch (const Error&) {
    return std::nullopt;
  }
}

fs::path& ConfigFolder() {
  static fs::path folder = PathFromCommand(CORVO_CONFIGS_FROM_COMMAND);
  return folder;
}

/// Returns the names of the shipped cameras that `is_wanted` accepts, sorted.
template <typename Predicate>
std::vector<std::string> NamesOf(Predicate&& is_wanted) {
  std::vector<std::string> names;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(ConfigFolder(), none)) {
    const std::optional<Camera> camera = FindCamera(entry.path());
    if (camera && is_wanted(*camera)) names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

void SetConfigFolder(const fs::path& folder) { ConfigFolder() = folder; }

std::vector<std::string> ShippedCameraNames() {
  return NamesOf([](const Camera&) { return true; });
}

std::vector<std::string> ShippedCameraNames(int width, int height) {
  return NamesOf(
      [&](const Camera& camera) { return camera.width() == width && camera.height() == height; });
}

fs::path ShippedCameraFile(const std::string& name) {
  for (const std::string& shipped : ShippedCameraNames()) {
    if (name == shipped || name == shipped + ".yaml") return ConfigFolder() / (shipped + ".yaml");
  }
  return {};
}

}  // namespace corvo
