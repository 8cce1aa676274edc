// SPDX-License-Identifier: MIT
#include "apps/run/progress_line.h"

#include <algorithm>
#include <cstdio>
#include <mutex>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "apps/system/decoder_messages.h"
#include "apps/system/terminal.h"

namespace corvo {
namespace {

constexpr double kMsBetweenBars = 100;
constexpr int kMaxBarColumns = 30;
constexpr int kMinBarColumns = 5;

std::string Bar(double share, int columns) {
  const int filled = std::clamp(static_cast<int>(share * columns), 0, columns);
  return fmt::format("[{:#<{}}{:.<{}}] ", "", filled, "", columns - filled);
}

}  // namespace

std::string ProgressBar(std::optional<double> share, const std::string& text, int columns) {
  const std::string shown = text.substr(0, std::max(columns, 0));
  const int room = columns - static_cast<int>(shown.size()) - 3;  // Brackets and a blank.
  if (!share || room < kMinBarColumns) return shown;
  return Bar(*share, std::min(room, kMaxBarColumns)) + shown;
}

ProgressLine::ProgressLine()
    : is_terminal_(spdlog::should_log(spdlog::level::info) && IsStandardErrorATerminal()) {}

ProgressLine::~ProgressLine() {
  const std::scoped_lock lock(MessageLock::mutex());
  if (is_terminal_) std::fputs(kEraseLine.data(), stderr);
}

void ProgressLine::Show(std::optional<double> share, const std::string& text) {
  if (!is_terminal_) return;
  const double now_ms = watch_.ElapsedMs();
  if (now_ms - last_drawn_ms_ < kMsBetweenBars && share != 1.0) return;
  last_drawn_ms_ = now_ms;
  const std::scoped_lock lock(MessageLock::mutex());
  const std::string bar = ProgressBar(share, text, TerminalColumns() - 1);
  std::fputs((std::string(kEraseLine) + bar).c_str(), stderr);
}

}  // namespace corvo
