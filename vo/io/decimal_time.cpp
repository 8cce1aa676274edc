// SPDX-License-Identifier: MIT
#include "vo/io/decimal_time.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "orb/error.h"

namespace corvo {
namespace {

/// Returns the number of decimals of a time in nanoseconds, if it is written in `unit`.
int NumDecimals(TimeUnit unit) {
  switch (unit) {
    case TimeUnit::kSeconds:
      return 9;
    case TimeUnit::kMilliseconds:
      return 6;
    case TimeUnit::kMicroseconds:
      return 3;
    case TimeUnit::kNanoseconds:
      break;
  }
  return 0;
}

std::string_view NameOf(TimeUnit unit) {
  switch (unit) {
    case TimeUnit::kSeconds:
      return "seconds";
    case TimeUnit::kMilliseconds:
      return "milliseconds";
    case TimeUnit::kMicroseconds:
      return "microseconds";
    case TimeUnit::kNanoseconds:
      break;
  }
  return "nanoseconds";
}

template <typename Integer>
std::optional<Integer> ParseInteger(std::string_view text) {
  Integer value = 0;
  const char* end = text.data() + text.size();
  const auto [parsed, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || parsed != end) return std::nullopt;
  return value;
}

/// A decimal number: value = digits * 10^exponent.
struct Decimal {
  bool negative = false;
  std::string digits;
  int exponent = 0;
};

std::optional<Decimal> ParseDecimal(std::string_view text) {
  Decimal decimal;
  if (!text.empty() && (text.front() == '-' || text.front() == '+')) {
    decimal.negative = text.front() == '-';
    text.remove_prefix(1);
  }
  bool after_point = false;
  while (!text.empty() && text.front() != 'e' && text.front() != 'E') {
    const char c = text.front();
    text.remove_prefix(1);
    if (c == '.' && !after_point) {
      after_point = true;
      continue;
    }
    if (c < '0' || c > '9') return std::nullopt;
    decimal.digits += c;
    if (after_point) --decimal.exponent;
  }
  if (decimal.digits.empty()) return std::nullopt;
  if (text.empty()) return decimal;
  text.remove_prefix(text.size() > 1 && text[1] == '+' ? 2 : 1);
  const auto exponent = ParseInteger<int>(text);
  if (!exponent || std::abs(*exponent) > 30) return std::nullopt;
  decimal.exponent += *exponent;
  return decimal;
}

/// Returns the integer nearest to a decimal, with halves rounded away from zero, or std::nullopt if
/// it overflows.
std::optional<TimeNs> Round(Decimal decimal) {
  bool round_up = false;
  if (decimal.exponent >= 0) {
    decimal.digits.append(decimal.exponent, '0');
  } else {
    const std::size_t dropped = -decimal.exponent;
    if (decimal.digits.size() < dropped + 1) {
      decimal.digits.insert(0, dropped + 1 - decimal.digits.size(), '0');
    }
    round_up = decimal.digits[decimal.digits.size() - dropped] >= '5';
    decimal.digits.resize(decimal.digits.size() - dropped);
  }
  const auto magnitude = ParseInteger<TimeNs>(decimal.digits);
  if (!magnitude) return std::nullopt;
  if (round_up && *magnitude == std::numeric_limits<TimeNs>::max()) return std::nullopt;
  const TimeNs rounded = *magnitude + (round_up ? 1 : 0);
  return decimal.negative ? -rounded : rounded;
}

}  // namespace

TimeUnit GuessTimeUnit(std::string_view text) {
  const std::optional<Decimal> decimal = ParseDecimal(text);
  if (!decimal) return TimeUnit::kSeconds;
  const std::size_t first =
      std::min(decimal->digits.find_first_not_of('0'), decimal->digits.size());
  const int num_digits = static_cast<int>(decimal->digits.size() - first) + decimal->exponent;
  if (num_digits >= 18) return TimeUnit::kNanoseconds;
  if (num_digits >= 15) return TimeUnit::kMicroseconds;
  return num_digits >= 12 ? TimeUnit::kMilliseconds : TimeUnit::kSeconds;
}

TimeUnit GuessEurocTimeUnit(std::string_view text) {
  const bool has_point = text.find('.') != std::string_view::npos;
  const bool is_in_seconds = has_point && GuessTimeUnit(text) == TimeUnit::kSeconds;
  return is_in_seconds ? TimeUnit::kSeconds : TimeUnit::kNanoseconds;
}

TimeNs ParseTime(std::string_view text, TimeUnit unit, std::string_view where) {
  std::optional<Decimal> decimal = ParseDecimal(text);
  if (decimal) {
    decimal->exponent += NumDecimals(unit);
    if (const auto time_ns = Round(*decimal)) return *time_ns;
  }
  throw Error(fmt::format("{}'{}' is not a time in {}", where, text, NameOf(unit)));
}

TimeNs ParseSeconds(std::string_view text, std::string_view where) {
  return ParseTime(text, TimeUnit::kSeconds, where);
}

std::string FormatSeconds(TimeNs time_ns) {
  constexpr TimeNs kNanosecondsPerSecond = 1'000'000'000;
  const TimeNs seconds = time_ns / kNanosecondsPerSecond;
  const TimeNs rest = time_ns % kNanosecondsPerSecond;
  return fmt::format("{}{}.{:09}", time_ns < 0 ? "-" : "", std::abs(seconds), std::abs(rest));
}

TimeNs ParseNanoseconds(std::string_view text, std::string_view where) {
  return ParseTime(text, TimeUnit::kNanoseconds, where);
}

void CheckAscends(TimeNs time_ns, const TimeNs* before_ns, std::string_view where) {
  if (before_ns == nullptr || time_ns > *before_ns) return;
  throw Error(fmt::format("{}time {} s does not lie after that of the pose before, {} s", where,
                          FormatSeconds(time_ns), FormatSeconds(*before_ns)));
}

}  // namespace corvo
