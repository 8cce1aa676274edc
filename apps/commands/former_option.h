// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <CLI/App.hpp>

namespace corvo {

/// Answers an option of an earlier version by an error that says what has taken its place.
inline void AddFormerOption(CLI::App& command, const std::string& name,
                            const std::string& replacement) {
  command
      .add_option_function<std::string>(name,
                                        [name, replacement](const std::string&) {
                                          throw CLI::ValidationError(name, replacement);
                                        })
      ->expected(0, 1)
      ->group("");
}

}  // namespace corvo
