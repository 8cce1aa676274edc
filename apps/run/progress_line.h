// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

#include "apps/run/stopwatch.h"

namespace corvo {

/// Returns a bar that shows the fraction `share`, followed by the text, in at most `columns`
/// characters. The bar is omitted if `share` is std::nullopt or there is no room.
std::string ProgressBar(std::optional<double> share, const std::string& text, int columns);

/// A progress line on standard error that is redrawn in place. Does nothing if standard error is
/// not a terminal or messages of the level info are off.
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
