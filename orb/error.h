// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>

namespace corvo {

/// The exception for misuse or bad input: a value out of range, an unreadable file, an image of the
/// wrong type. The message names the file or field, the value, and what is allowed. Tracking loss
/// is not an Error.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Throws Error("<field> is <value>; allowed is <min> to <max>") unless min <= value <= max.
/// NaN is never in range.
template <typename T>
void CheckRange(std::string_view field, const T& value, const T& min, const T& max) {
  if (value >= min && value <= max) return;
  std::ostringstream message;
  message << field << " is " << value << "; allowed is " << min << " to " << max;
  throw Error(message.str());
}

/// Like CheckRange, for finite numbers above 0.
inline void CheckPositive(std::string_view field, double value) {
  using Limits = std::numeric_limits<double>;
  CheckRange(field, value, Limits::min(), Limits::max());
}

}  // namespace corvo
