// SPDX-License-Identifier: MIT
#include "apps/run/progress.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

namespace corvo {
namespace {

constexpr int kFramesBetweenLines = 100;

}  // namespace

std::string ProgressText(const Progress& progress) {
  std::string text = fmt::format("frame {}", progress.frame.index + 1);
  if (progress.num_frames > 0) text += fmt::format(" of {}", progress.num_frames);
  text += fmt::format(": {}, {} inliers, {:.1f} frames/s", ToString(progress.frame.state),
                      progress.frame.num_inliers, progress.frames_per_second);
  const int num_left = progress.num_frames - progress.frame.index - 1;
  if (num_left <= 0) return text;
  return text + fmt::format(", {} left", DurationText(num_left / progress.frames_per_second));
}

std::string DurationText(double seconds) {
  const auto whole = static_cast<std::int64_t>(std::ceil(seconds));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{}:{:02} min", whole / 60, whole % 60);
  return fmt::format("{}:{:02} h", whole / 3600, whole % 3600 / 60);
}

std::optional<double> ShareDone(const Progress& progress) {
  if (progress.num_frames == 0) return std::nullopt;
  return (progress.frame.index + 1.0) / progress.num_frames;
}

void ProgressReport::Add(const FrameResult& frame) {
  const int count = frame.index + 1;
  const double elapsed_ms = std::max(watch_.ElapsedMs(), 1e-3);
  const Progress progress{frame, num_frames_, 1e3 * count / elapsed_ms};
  if (line_.is_terminal()) {
    line_.Show(ShareDone(progress), ProgressText(progress));
  } else if (count % kFramesBetweenLines == 0) {
    spdlog::info("{}", ProgressText(progress));
  }
}

}  // namespace corvo
