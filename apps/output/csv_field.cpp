// SPDX-License-Identifier: MIT
#include "apps/output/csv_field.h"

namespace corvo {

std::string ToCsvField(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

std::string FromCsvField(const std::string& field) {
  if (!field.starts_with('"')) return field;
  std::string text;
  for (std::size_t i = 1; i + 1 < field.size(); ++i) {
    text += field[i];
    i += field[i] == '"';
  }
  return text;
}

}  // namespace corvo
