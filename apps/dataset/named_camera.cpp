// SPDX-License-Identifier: MIT
#include "apps/dataset/named_camera.h"

#include <string>

#include <fmt/format.h>

#include "apps/dataset/shipped_cameras.h"
#include "orb/error.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

/// Returns whether a text can be the name of a camera, not that of a file.
bool IsWord(const std::string& text) { return text.find_first_of("/.") == std::string::npos; }

}  // namespace

CalibrationFile ReadNamedCamera(const fs::path& named) {
  std::error_code none;
  if (fs::exists(named, none)) return ReadCalibrationFile(named);
  const std::string text = named.string();
  const std::size_t colon = text.rfind(':');
  if (colon != std::string::npos && fs::exists(text.substr(0, colon), none)) {
    return ReadCalibrationFile(text.substr(0, colon), text.substr(colon + 1));
  }
  const fs::path shipped = ShippedCameraFile(text);
  if (!shipped.empty()) return ReadCalibrationFile(shipped);
  if (!IsWord(text)) return ReadCalibrationFile(named);
  throw Error(
      fmt::format("{}: there is no such file, and no camera of this name is shipped with corvo; "
                  "shipped are {}",
                  text, fmt::join(ShippedCameraNames(), ", ")));
}

}  // namespace corvo
