// SPDX-License-Identifier: MIT
#include "apps/dataset/kitti_raw_times.h"

#include <chrono>
#include <cstdio>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "orb/error.h"
#include "vo/io/decimal_time.h"
#include "vo/io/text_lines.h"

namespace corvo {
namespace {

constexpr TimeNs kSecondNs = 1'000'000'000;

/// Parses "year-month-day hour:minute:second", of which the second has decimals.
std::optional<TimeNs> ParseDateTime(const std::string& text, const std::string& where) {
  unsigned year = 0, month = 0, day = 0, hour = 0, minute = 0;
  int length = 0;
  const int num_read = std::sscanf(text.c_str(), "%4u-%2u-%2u %2u:%2u:%n", &year, &month, &day,
                                   &hour, &minute, &length);
  const std::chrono::year_month_day date(std::chrono::year(static_cast<int>(year)),
                                         std::chrono::month(month), std::chrono::day(day));
  if (num_read != 5 || length == 0 || !date.ok() || year < 1970 || year > 2200 || hour > 23 ||
      minute > 59) {
    return std::nullopt;
  }
  const TimeNs second_ns = ParseSeconds(text.substr(static_cast<std::size_t>(length)), where);
  if (second_ns < 0 || second_ns > 60 * kSecondNs) return std::nullopt;
  const std::int64_t days = std::chrono::sys_days(date).time_since_epoch().count();
  return ((days * 24 + hour) * 60 + minute) * 60 * kSecondNs + second_ns;
}

}  // namespace

std::vector<TimeNs> ReadKittiRawTimes(const std::filesystem::path& file) {
  std::vector<TimeNs> times;
  for (const TextLine& line : ReadTextLines(file)) {
    const std::string where = LinePrefix(file, line);
    const std::optional<TimeNs> time_ns = ParseDateTime(line.text, where);
    if (!time_ns) {
      throw Error(
          fmt::format("{}'{}' is not 'year-month-day hour:minute:second'", where, line.text));
    }
    times.push_back(*time_ns);
  }
  return times;
}

}  // namespace corvo
