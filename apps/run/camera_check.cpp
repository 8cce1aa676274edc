// SPDX-License-Identifier: MIT
#include "apps/run/camera_check.h"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "orb/error.h"
#include "vo/camera/camera_plausibility.h"

namespace corvo {

std::vector<std::string> CheckCamera(const std::filesystem::path& origin,
                                     const CameraParameters& camera) {
  try {
    CheckPlausible(camera);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", origin.string(), error.what()));
  }
  std::vector<std::string> warnings;
  for (const std::string& value : UnusualValues(camera)) {
    warnings.push_back(fmt::format("{}: {}", origin.string(), value));
    spdlog::warn("{}", warnings.back());
  }
  return warnings;
}

}  // namespace corvo
