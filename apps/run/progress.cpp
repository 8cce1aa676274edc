// SPDX-License-Identifier: MIT
#include "apps/run/progress.h"

#include <algorithm>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

namespace corvo {
namespace {

constexpr int kFramesBetweenLines = 100;

}  // namespace

std::string ProgressText(const Progress& progress) {
  std::string text = fmt::format("frame {}", progress.frame.index + 1);
  if (progress.num_frames > 0) text += fmt::format(" of {}", progress.num_frames);
  return text + fmt::format(": {}, {} inliers, {:.1f} frames/s", ToString(progress.frame.state),
                            progress.frame.num_inliers, progress.frames_per_second);
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
