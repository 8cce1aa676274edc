// SPDX-License-Identifier: MIT
#include "vo/io/decimal_time.h"

#include <charconv>
#include <cstdlib>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "orb/error.h"

namespace corvo {
namespace {

constexpr int kNanosecondDigits = 9;

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
  const TimeNs rounded = *magnitude + (round_up ? 1 : 0);
  return decimal.negative ? -rounded : rounded;
}

}  // namespace

TimeNs ParseSeconds(std::string_view text, std::string_view where) {
  std::optional<Decimal> decimal = ParseDecimal(text);
  if (decimal) {
    decimal->exponent += kNanosecondDigits;
    if (const auto time_ns = Round(*decimal)) return *time_ns;
  }
  throw Error(fmt::format("{}'{}' is not a time in seconds", where, text));
}

std::string FormatSeconds(TimeNs time_ns) {
  constexpr TimeNs kNanosecondsPerSecond = 1'000'000'000;
  const TimeNs seconds = time_ns / kNanosecondsPerSecond;
  const TimeNs rest = time_ns % kNanosecondsPerSecond;
  return fmt::format("{}{}.{:09}", time_ns < 0 ? "-" : "", std::abs(seconds), std::abs(rest));
}

TimeNs ParseNanoseconds(std::string_view text, std::string_view where) {
  if (const auto time_ns = ParseInteger<TimeNs>(text)) return *time_ns;
  throw Error(fmt::format("{}'{}' is not a time in nanoseconds", where, text));
}

}  // namespace corvo
