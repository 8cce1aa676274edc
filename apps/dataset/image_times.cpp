// SPDX-License-Identifier: MIT
#include "apps/dataset/image_times.h"

#include <algorithm>
#include <cctype>
#include <string>

#include <fmt/format.h>

#include "orb/error.h"
#include "vo/io/decimal_time.h"
#include "vo/io/text_lines.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

constexpr TimeNs kYear2000 = 946'684'800'000'000'000;
constexpr TimeNs kYear2100 = 4'102'444'800'000'000'000;

/// Returns whether a text is digits with at most one decimal point.
bool IsPlainNumber(const std::string& text) {
  return std::ranges::count(text, '.') <= 1 &&
         std::ranges::any_of(text, [](unsigned char c) { return std::isdigit(c) != 0; }) &&
         std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c) || c == '.'; });
}

std::optional<TimeNs> TimeInName(const fs::path& file) {
  const std::string stem = file.stem().string();
  if (!IsPlainNumber(stem)) return std::nullopt;
  try {
    const TimeNs time_ns = ParseTime(stem, GuessTimeUnit(stem), "");
    return time_ns >= kYear2000 && time_ns < kYear2100 ? std::optional(time_ns) : std::nullopt;
  } catch (const Error&) {  // Too large for a TimeNs.
    return std::nullopt;
  }
}

bool IsNameOf(const std::string& text, const fs::path& image) {
  const std::string name = fs::path(text).filename().string();
  return name == image.filename().string() || name == image.stem().string();
}

/// Returns the field with the time of a row that belongs to `image`.
std::string TimeField(const TextLine& line, const fs::path& image, const fs::path& file) {
  const std::vector<std::string> fields = SplitFields(line.text);
  if (fields.size() == 1 || IsNameOf(fields[1], image)) return fields[0];
  if (IsNameOf(fields[0], image)) return fields[1];
  throw Error(fmt::format("{}'{}' is neither a time nor names the image {}", LinePrefix(file, line),
                          line.text, image.filename().string()));
}

}  // namespace

std::optional<std::vector<TimeNs>> TimesInNames(const std::vector<fs::path>& files) {
  std::vector<TimeNs> times;
  for (const fs::path& file : files) {
    const std::optional<TimeNs> time_ns = TimeInName(file);
    if (!time_ns || (!times.empty() && *time_ns <= times.back())) return std::nullopt;
    times.push_back(*time_ns);
  }
  return times;
}

std::vector<TimeNs> ReadImageTimes(const fs::path& file, const std::vector<fs::path>& images) {
  const std::vector<TextLine> lines = ReadTableLines(file);
  if (lines.size() != images.size()) {
    throw Error(
        fmt::format("{}: {} timestamps for {} images", file.string(), lines.size(), images.size()));
  }
  std::vector<TimeNs> times;
  TimeUnit unit = TimeUnit::kSeconds;
  for (std::size_t i = 0; i < images.size(); ++i) {
    const std::string text = TimeField(lines[i], images[i], file);
    if (i == 0) unit = GuessTimeUnit(text);
    times.push_back(ParseTime(text, unit, LinePrefix(file, lines[i])));
  }
  return times;
}

}  // namespace corvo
