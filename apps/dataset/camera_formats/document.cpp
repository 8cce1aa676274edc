// SPDX-License-Identifier: MIT
#include "apps/dataset/camera_formats/document.h"

#include <sstream>

#include <fmt/format.h>

#include "orb/error.h"
#include "vo/io/file_bytes.h"
#include "vo/io/text_lines.h"
#include "vo/io/yaml_document.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

bool StartsWith(std::string_view text, char c) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && text[first] == c;
}

void CheckSize(std::string_view text, const fs::path& file) {
  if (text.size() <= kMaxYamlBytes) return;
  throw Error(fmt::format("{}: has more than {} bytes; allowed is 0 to {}", file.string(),
                          kMaxYamlBytes, kMaxYamlBytes));
}

/// Returns a text whose directives, such as %YAML:1.0, are empty lines.
std::string WithoutDirectives(std::string_view text) {
  std::istringstream stream{std::string(text)};
  std::string plain;
  for (std::string line; std::getline(stream, line);) {
    plain += (line.starts_with('%') ? "" : line) + "\n";
  }
  return plain;
}

}  // namespace

bool StartsLikeJson(std::string_view text) { return StartsWith(text, '{'); }
bool StartsLikeXml(std::string_view text) { return StartsWith(text, '<'); }

YAML::Node ParseDocument(const std::string& text, const fs::path& file) {
  const std::string_view plain = WithoutByteOrderMark(text, file.string());
  if (StartsLikeJson(plain)) {
    const YAML::Node root = ParseJson(plain, file);
    if (root.IsDefined()) return root;
  }
  CheckSize(plain, file);
  if (StartsLikeXml(plain)) return ParseXml(plain, file);
  return ParseYaml(WithoutDirectives(plain), file);
}

YAML::Node ReadDocument(const fs::path& file) {
  return ParseDocument(ReadFileBytes(file, kMaxCalibrationBytes), file);
}

}  // namespace corvo
