// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "vo/core/conventions.h"

namespace corvo {

/// Nanoseconds of a decimal number of seconds, such as "1305031229.528748" or "1.000000e-01":
/// exact (never through a double), rounded to the nearest where it has more than nine decimals.
/// `where` starts the message of the corvo::Error for anything else.
TimeNs ParseSeconds(std::string_view text, std::string_view where);

/// Seconds with nine decimals, such as "1305031229.528748000"; exact.
std::string FormatSeconds(TimeNs time_ns);

/// A whole number of nanoseconds.
TimeNs ParseNanoseconds(std::string_view text, std::string_view where);

}  // namespace corvo
