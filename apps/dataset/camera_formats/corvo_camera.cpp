// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "apps/dataset/camera_formats/camera_formats.h"
#include "apps/dataset/camera_formats/document_fields.h"
#include "orb/error.h"
#include "vo/io/file_bytes.h"

namespace corvo {

std::vector<std::string> CorvoCameras(const CalibrationContent& content) {
  constexpr std::array<std::string_view, 4> kOwnKeys = {"model", "width", "height", "fx"};
  const std::vector<std::string> keys = KeysOf(content.root());
  const auto is_key = [&](std::string_view own) {
    return std::ranges::find(keys, own) != keys.end();
  };
  if (std::ranges::none_of(kOwnKeys, is_key)) return {};
  return {""};
}

StatedCamera ReadCorvoCamera(const CalibrationContent& content, const std::string& /*name*/) {
  if (content.bytes().size() > kMaxYamlBytes) {
    throw Error(fmt::format("{}has more than {} bytes; allowed is 0 to {}", content.where(),
                            kMaxYamlBytes, kMaxYamlBytes));
  }
  CameraFile file = ParseCameraFile(content.bytes(), content.file());
  return {file.camera.parameters(), file.frame_rate_hz, content.where(), file.source, file.sigma};
}

}  // namespace corvo
