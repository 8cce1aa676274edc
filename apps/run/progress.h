// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "apps/run/progress_line.h"
#include "apps/run/stopwatch.h"
#include "vo/core/frame_result.h"

namespace corvo {

/// The progress of a run after a frame.
struct Progress {
  FrameResult frame;
  int num_frames = 0;  ///< Length of the sequence; 0 if it is unknown.
  double frames_per_second = 0;
};

/// Returns text like "frame 100 of 300: tracking, 156 inliers, 32.1 frames/s, 7 s left".
std::string ProgressText(const Progress& progress);

/// Returns a duration, rounded up to seconds, like "7 s", "2:05 min" or "1:02 h".
std::string DurationText(double seconds);

/// Returns the fraction of the frames that are processed, or std::nullopt if the length of the
/// sequence is unknown.
std::optional<double> ShareDone(const Progress& progress);

/// Reports the progress of a run on standard error: as a bar on a terminal, otherwise as one line
/// every 100 frames.
class ProgressReport {
 public:
  explicit ProgressReport(int num_frames) : num_frames_(num_frames) {}

  void Add(const FrameResult& frame);

 private:
  int num_frames_;
  ProgressLine line_;
  Stopwatch watch_;
};

}  // namespace corvo
