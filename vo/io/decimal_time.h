// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "vo/core/conventions.h"

namespace corvo {

/// Returns the nanoseconds of a decimal number of seconds, e.g. "1305031229.528748" or
/// "1.000000e-01": exact (never through a double), rounded to the nearest if there are more than
/// nine decimals. Throws corvo::Error, whose message starts with `where`, for any other text.
TimeNs ParseSeconds(std::string_view text, std::string_view where);

/// Returns seconds with nine decimals, e.g. "1305031229.528748000"; exact.
std::string FormatSeconds(TimeNs time_ns);

/// Returns a whole number of nanoseconds. Throws corvo::Error, whose message starts with `where`,
/// for any other text.
TimeNs ParseNanoseconds(std::string_view text, std::string_view where);

}  // namespace corvo
