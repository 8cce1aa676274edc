// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include <yaml-cpp/yaml.h>

namespace corvo {

/// A dataset's YAML file, which as OpenCV writes it may start with "%YAML:1.0", which YAML itself
/// does not allow. Throws corvo::Error where it cannot be read, YAML::Exception where it is no
/// YAML.
YAML::Node LoadSensorYaml(const std::filesystem::path& file);

}  // namespace corvo
