// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace corvo {

/// Returns a field of a CSV file, in quotes if it needs them (RFC 4180).
std::string ToCsvField(const std::string& text);

/// Returns the text of a field: the inverse of ToCsvField().
std::string FromCsvField(const std::string& field);

}  // namespace corvo
