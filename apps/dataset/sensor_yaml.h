// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include <yaml-cpp/yaml.h>

namespace corvo {

/// Loads the YAML file of a dataset, which may start with "%YAML:1.0" as written by OpenCV,
/// although this is not valid YAML. Throws corvo::Error with file and line as ReadYaml() does.
YAML::Node LoadSensorYaml(const std::filesystem::path& file);

}  // namespace corvo
