// SPDX-License-Identifier: MIT
#include "apps/dataset/sensor_yaml.h"

#include <fstream>
#include <sstream>
#include <string>

#include <fmt/format.h>

#include "orb/error.h"

namespace corvo {

YAML::Node LoadSensorYaml(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw Error(fmt::format("{}: cannot be read", file.string()));
  std::stringstream text;
  for (std::string line; std::getline(stream, line);) {
    text << (line.rfind('%', 0) == 0 ? "" : line) << '\n';
  }
  return YAML::Load(text);
}

}  // namespace corvo
