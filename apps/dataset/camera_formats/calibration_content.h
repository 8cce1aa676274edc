// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <yaml-cpp/yaml.h>

#include "vo/io/text_lines.h"

namespace corvo {

/// The content of a calibration file as the readers of its possible forms need it. Its parts are
/// computed when they are first needed; not thread-safe.
class CalibrationContent {
 public:
  /// Throws corvo::Error if `bytes` is UTF-16 text.
  CalibrationContent(std::string bytes, std::filesystem::path file);

  const std::filesystem::path& file() const { return file_; }
  const std::string& bytes() const { return bytes_; }
  /// Returns "<file>: ", the start of error messages.
  std::string where() const;

  /// Returns whether the content is not text: it holds a NUL byte.
  bool is_binary() const { return kind_ == Kind::kBinary; }
  bool is_json() const { return kind_ == Kind::kJson; }

  /// Returns the lines of a text, without comments. Empty if the content is binary, JSON or XML.
  const std::vector<TextLine>& lines() const;

  /// Returns the mapping that a YAML, JSON or XML text is; a null node if the content is binary or
  /// no mapping. Throws corvo::Error as ParseDocument() does.
  const YAML::Node& root() const;

 private:
  enum class Kind { kBinary, kJson, kXml, kText };

  std::filesystem::path file_;
  std::string bytes_;
  Kind kind_;
  mutable std::optional<std::vector<TextLine>> lines_;
  mutable std::optional<YAML::Node> root_;
};

/// Returns the fields of a line, or none if the line is too long to be that of a calibration.
std::vector<std::string> CalibrationFields(const TextLine& line);

}  // namespace corvo
