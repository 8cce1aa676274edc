// SPDX-License-Identifier: MIT
#include "vo/io/text_lines.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "orb/error.h"
#include "vo/io/file_bytes.h"

namespace corvo {
namespace {

constexpr std::string_view kBlanks = " \t\r\n\f\v";
constexpr std::string_view kSeparators = ",;";
constexpr std::string_view kFieldEnds = " \t\r\n\f\v,;";

std::string_view Trim(std::string_view text) {
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

/// Returns the number of characters from `begin`, where a field has ended, to the next field.
std::size_t SeparatorSize(std::string_view text, std::size_t begin) {
  const std::size_t mark = std::min(text.find_first_not_of(kBlanks, begin), text.size());
  if (mark == text.size() || kSeparators.find(text[mark]) == std::string_view::npos) {
    return mark - begin;
  }
  return std::min(text.find_first_not_of(kBlanks, mark + 1), text.size()) - begin;
}

}  // namespace

bool IsNumber(std::string_view text) {
  double value = 0;
  const char* end = text.data() + text.size();
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  return std::from_chars(text.data(), end, value).ptr == end && !text.empty();
}

std::string_view WithoutByteOrderMark(std::string_view text, const std::string& name) {
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    throw Error(fmt::format("{}: is UTF-16 text; save it as UTF-8", name));
  }
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return text;
}

std::vector<TextLine> ReadTextLines(const std::filesystem::path& file) {
  return ParseTextLines(ReadFileBytes(file, kMaxTextBytes), file);
}

std::vector<TextLine> ParseTextLines(std::string_view bytes, const std::filesystem::path& file) {
  std::string_view rest = WithoutByteOrderMark(bytes, file.string());
  if (rest.find('\0') != std::string_view::npos) {
    throw Error(fmt::format("{}: is not a text file: it holds a NUL byte", file.string()));
  }
  std::vector<TextLine> lines;
  for (int number = 1; !rest.empty(); ++number) {
    const std::size_t end = std::min(rest.find_first_of("\r\n"), rest.size());
    const std::string_view text = Trim(rest.substr(0, end));
    rest.remove_prefix(end);
    rest.remove_prefix(rest.starts_with("\r\n") ? 2 : std::min<std::size_t>(1, rest.size()));
    if (text.empty() || text.front() == '#') continue;
    if (lines.size() == kMaxTextLines) {
      throw Error(fmt::format("{}: has more than {} lines; allowed is 0 to {}", file.string(),
                              kMaxTextLines, kMaxTextLines));
    }
    lines.push_back({number, std::string(text)});
  }
  return lines;
}

std::vector<TextLine> ReadTableLines(const std::filesystem::path& file) {
  std::vector<TextLine> lines = ReadTextLines(file);
  if (lines.empty()) return lines;
  const std::vector<std::string> fields = SplitFields(lines.front().text);
  if (std::none_of(fields.begin(), fields.end(), IsNumber)) lines.erase(lines.begin());
  return lines;
}

std::vector<std::string> SplitFields(std::string_view text) {
  std::vector<std::string> fields;
  text = Trim(text);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of(kFieldEnds), text.size());
    fields.emplace_back(text.substr(0, end));
    const std::size_t next = end + SeparatorSize(text, end);
    const bool ends_with_separator = next == text.size() && end < text.size();
    text.remove_prefix(next);
    if (ends_with_separator) fields.emplace_back();
  }
  return fields;
}

std::string_view AfterFirstField(std::string_view text) {
  text = Trim(text);
  const std::size_t end = std::min(text.find_first_of(kFieldEnds), text.size());
  return text.substr(end + SeparatorSize(text, end));
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
