// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace corvo {

/// Moves to the start of the terminal's line and erases it.
inline constexpr std::string_view kEraseLine = "\r\x1b[K";

/// Returns whether standard error is shown on a terminal.
bool IsStandardErrorATerminal();

/// Returns the width of the terminal that standard error is shown on; 80 if it is unknown.
int TerminalColumns();

}  // namespace corvo
