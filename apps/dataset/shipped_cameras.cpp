// SPDX-License-Identifier: MIT
#include "apps/dataset/shipped_cameras.h"

#include <algorithm>

#include "orb/error.h"
#include "vo/io/config.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

bool FitsSize(const fs::path& file, int width, int height) {
  try {
    const Camera camera = ReadCameraFile(file).camera;
    return camera.width() == width && camera.height() == height;
  } catch (const Error&) {
    return false;  // An options file, not a camera file.
  }
}

/// Returns the folder of configurations, whose path relative to the executable is the same in the
/// build tree and when installed.
fs::path ConfigFolder() {
  std::error_code none;
  const fs::path command = fs::read_symlink("/proc/self/exe", none);
  return (command.parent_path() / CORVO_CONFIGS_FROM_COMMAND).lexically_normal();
}

}  // namespace

std::vector<fs::path> FindShippedCameras(int width, int height) {
  std::vector<fs::path> files;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(ConfigFolder(), none)) {
    if (FitsSize(entry.path(), width, height)) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace corvo
