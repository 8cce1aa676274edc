#include "apps/progress.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace corvo {
namespace {

constexpr int kFramesBetweenLines = 100;
constexpr double kMsBetweenBars = 100;
constexpr int kDefaultColumns = 80;
constexpr int kMaxBarColumns = 30;
constexpr int kMinBarColumns = 5;
constexpr const char* kEraseLine = "\r\x1b[K";

int TerminalColumns() {
  winsize size{};
  const bool known = ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : kDefaultColumns;
}

std::string Bar(double share, int columns) {
  const int filled = std::clamp(static_cast<int>(share * columns), 0, columns);
  return fmt::format("[{:#<{}}{:.<{}}] ", "", filled, "", columns - filled);
}

}  // namespace

std::string ProgressText(const Progress& progress) {
  std::string text = fmt::format("frame {}", progress.frame.index + 1);
  if (progress.num_frames > 0) text += fmt::format(" of {}", progress.num_frames);
  return text + fmt::format(": {}, {} inliers, {:.1f} frames/s", ToString(progress.frame.state),
                            progress.frame.num_inliers, progress.frames_per_second);
}

std::string ProgressBar(const Progress& progress, int columns) {
  const std::string text = ProgressText(progress).substr(0, std::max(columns, 0));
  const int room = columns - static_cast<int>(text.size()) - 3;  // Brackets and a blank.
  if (progress.num_frames == 0 || room < kMinBarColumns) return text;
  const double share = (progress.frame.index + 1.0) / progress.num_frames;
  return Bar(share, std::min(room, kMaxBarColumns)) + text;
}

ProgressReport::ProgressReport(int num_frames)
    : num_frames_(num_frames), is_terminal_(isatty(STDERR_FILENO) != 0) {}

ProgressReport::~ProgressReport() {
  if (is_terminal_) std::fputs(kEraseLine, stderr);
}

void ProgressReport::Add(const FrameResult& frame) {
  const int count = frame.index + 1;
  const double elapsed_ms = std::max(watch_.ElapsedMs(), 1e-3);
  const Progress progress{frame, num_frames_, 1e3 * count / elapsed_ms};
  if (!is_terminal_) {
    if (count % kFramesBetweenLines == 0) spdlog::info("{}", ProgressText(progress));
    return;
  }
  if (elapsed_ms - last_drawn_ms_ < kMsBetweenBars && count != num_frames_) return;
  last_drawn_ms_ = elapsed_ms;
  std::fputs((kEraseLine + ProgressBar(progress, TerminalColumns() - 1)).c_str(), stderr);
}

}  // namespace corvo
