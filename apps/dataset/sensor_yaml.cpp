// SPDX-License-Identifier: MIT
#include "apps/dataset/sensor_yaml.h"

#include <sstream>
#include <string>

#include "vo/io/file_bytes.h"
#include "vo/io/text_lines.h"
#include "vo/io/yaml_document.h"

namespace corvo {

YAML::Node LoadSensorYaml(const std::filesystem::path& file) {
  const std::string bytes = ReadFileBytes(file, kMaxYamlBytes);
  std::istringstream stream(std::string(WithoutByteOrderMark(bytes, file.string())));
  std::string text;
  for (std::string line; std::getline(stream, line);) {
    text += (line.rfind('%', 0) == 0 ? "" : line) + "\n";
  }
  return ParseYaml(text, file);
}

}  // namespace corvo
