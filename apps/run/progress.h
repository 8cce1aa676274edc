// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "apps/run/progress_line.h"
#include "apps/run/stopwatch.h"
#include "vo/core/frame_result.h"

namespace corvo {

/// How far a run is, after a frame.
struct Progress {
  FrameResult frame;
  int num_frames = 0;  ///< Of the sequence; 0 where its end is not known.
  double frames_per_second = 0;
};

/// "frame 100 of 300: tracking, 156 inliers, 32.1 frames/s"
std::string ProgressText(const Progress& progress);

/// The share of the frames that are done; none where the sequence's end is not known.
std::optional<double> ShareDone(const Progress& progress);

/// Tells on standard error how far a run is: on a terminal a bar that is drawn over, else a line
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
