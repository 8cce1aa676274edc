// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <fmt/format.h>
#include <CLI/Validators.hpp>

#include "orb/error.h"
#include "vo/io/text_lines.h"

namespace corvo {

/// Returns a check of an option whose value must be a finite number from `min` to `max`. Unlike
/// CLI::Range, it rejects NaN and infinity. All options that take a fractional number use it.
inline CLI::Validator NumberRange(double min, double max) {
  const auto check = [min, max](std::string& text) -> std::string {
    try {
      CheckRange(text, ParseNumber(text, ""), min, max);
      return "";
    } catch (const Error&) {
      return fmt::format("{} is not a number from {} to {}", text, min, max);
    }
  };
  return CLI::Validator(check, fmt::format("FLOAT in [{} - {}]", min, max));
}

}  // namespace corvo
