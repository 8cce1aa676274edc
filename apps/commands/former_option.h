#pragma once

#include <string>

#include <CLI/App.hpp>

namespace corvo {

/// Answers an option of an earlier version by an error that says what has taken its place.
inline void AddFormerOption(CLI::App& command, const std::string& name,
                            const std::string& replacement) {
  command
      .add_flag_callback(name,
                         [name, replacement] { throw CLI::ValidationError(name, replacement); })
      ->allow_extra_args()
      ->group("");
}

}  // namespace corvo
