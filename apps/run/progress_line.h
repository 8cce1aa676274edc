// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "apps/run/stopwatch.h"

namespace corvo {

/// The text after a bar that shows the share done, in at most `columns` characters. Without a bar
/// where the share is not known or there is no room.
std::string ProgressBar(std::optional<double> share, const std::string& text, int columns);

/// A line on standard error that is drawn over as things go on; nothing where that is no terminal.
class ProgressLine {
 public:
  ProgressLine();
  /// Erases the line.
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  bool is_terminal() const { return is_terminal_; }

  /// Draws ProgressBar(), at most every 100 ms unless the share is 1.
  void Show(std::optional<double> share, const std::string& text);

 private:
  bool is_terminal_;
  double last_drawn_ms_ = 0;
  Stopwatch watch_;
};

}  // namespace corvo
