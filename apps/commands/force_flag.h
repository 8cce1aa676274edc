// SPDX-License-Identifier: MIT
#pragma once

#include <CLI/App.hpp>

namespace corvo {

/// Adds --force. Without it, only files that an earlier corvo wrote are replaced.
inline void AddForceFlag(CLI::App& command, bool& force) {
  command.add_flag("--force", force,
                   "replace files of the results' names, also those that corvo has not written or "
                   "that were changed since");
}

}  // namespace corvo
