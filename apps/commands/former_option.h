// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <CLI/App.hpp>

namespace corvo {

/// Adds a hidden option of an earlier version that fails with the message `replacement`.
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
