// SPDX-License-Identifier: MIT
#include "apps/system/terminal.h"

#include <sys/ioctl.h>
#include <unistd.h>

namespace corvo {

bool IsStandardErrorATerminal() { return isatty(STDERR_FILENO) != 0; }

int TerminalColumns() {
  constexpr int kDefaultColumns = 80;
  winsize size{};
  const bool is_known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return is_known ? size.ws_col : kDefaultColumns;
}

}  // namespace corvo
