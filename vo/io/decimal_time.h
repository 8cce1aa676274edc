// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "vo/core/conventions.h"

namespace corvo {

/// The unit of the times in a file.
enum class TimeUnit { kSeconds, kMilliseconds, kMicroseconds, kNanoseconds };

/// Returns the unit in which a time of this magnitude is a date between 1973 and 5138: nanoseconds
/// from 1e17, microseconds from 1e14, milliseconds from 1e11. Smaller values, and texts that are
/// no numbers, are in seconds.
TimeUnit GuessTimeUnit(std::string_view text);

/// Returns the unit of a time in EuRoC's tables, which are in nanoseconds: other writers put
/// seconds there, with a decimal point and of the magnitude of seconds.
TimeUnit GuessEurocTimeUnit(std::string_view text);

/// Returns the nanoseconds of a decimal number in `unit`, e.g. "1305031229.528748" or
/// "1.403636579763555584e+18": exact (never through a double), with halves rounded away from zero.
/// Throws corvo::Error, whose message starts with `where`, for any other text and for times that a
/// TimeNs cannot hold.
TimeNs ParseTime(std::string_view text, TimeUnit unit, std::string_view where);

/// Like ParseTime(), in seconds.
TimeNs ParseSeconds(std::string_view text, std::string_view where);

/// Returns seconds with nine decimals, e.g. "1305031229.528748000"; exact.
std::string FormatSeconds(TimeNs time_ns);

/// Like ParseTime(), in nanoseconds.
TimeNs ParseNanoseconds(std::string_view text, std::string_view where);

/// Throws corvo::Error, whose message starts with `where`, if `before_ns` is given and `time_ns` is
/// not later.
void CheckAscends(TimeNs time_ns, const TimeNs* before_ns, std::string_view where);

}  // namespace corvo
