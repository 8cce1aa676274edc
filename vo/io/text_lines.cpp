// SPDX-License-Identifier: MIT
#include "vo/io/text_lines.h"

#include <charconv>
#include <cmath>
#include <fstream>

#include <fmt/format.h>

#include "orb/error.h"

namespace corvo {
namespace {

constexpr std::string_view kBlanks = " \t\r\n\f\v";

std::string_view Trim(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::vector<std::string> SplitAtBlanks(std::string_view text) {
  std::vector<std::string> fields;
  for (text = Trim(text); !text.empty(); text = Trim(text)) {
    const std::size_t end = std::min(text.find_first_of(kBlanks), text.size());
    fields.emplace_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return fields;
}

}  // namespace

std::vector<TextLine> ReadTextLines(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream || std::filesystem::is_directory(file)) {
    throw Error(fmt::format("{}: cannot be read", file.string()));
  }
  std::vector<TextLine> lines;
  std::string raw;
  for (int number = 1; std::getline(stream, raw); ++number) {
    const std::string_view text = Trim(raw);
    if (text.empty() || text.front() == '#') continue;
    lines.push_back({number, std::string(text)});
  }
  return lines;
}

std::vector<std::string> SplitFields(std::string_view text, char separator) {
  if (separator == ' ') return SplitAtBlanks(text);
  std::vector<std::string> fields;
  for (;;) {
    const std::size_t end = text.find(separator);
    fields.emplace_back(Trim(text.substr(0, end)));
    if (end == std::string_view::npos) return fields;
    text.remove_prefix(end + 1);
  }
}

std::string LinePrefix(const std::filesystem::path& file, const TextLine& line) {
  return fmt::format("{}:{}: ", file.string(), line.number);
}

double ParseNumber(std::string_view text, std::string_view where) {
  std::string_view digits = text;
  if (digits.size() > 1 && digits[0] == '+' && digits[1] != '-') digits.remove_prefix(1);
  double value = 0;
  const char* end = digits.data() + digits.size();
  const auto [parsed, error] = std::from_chars(digits.data(), end, value);
  if (error != std::errc() || parsed != end || !std::isfinite(value)) {
    throw Error(fmt::format("{}'{}' is not a number", where, text));
  }
  return value;
}

}  // namespace corvo
