// SPDX-License-Identifier: MIT
#pragma once

namespace corvo {

/// Returns whether standard error is shown on a terminal.
bool IsStandardErrorATerminal();

/// Returns the width of the terminal that standard error is shown on; 80 if it is unknown.
int TerminalColumns();

}  // namespace corvo
