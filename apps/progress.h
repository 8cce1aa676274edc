#pragma once

#include <string>

#include "apps/stopwatch.h"
#include "vo/frame_result.h"

namespace corvo {

/// How far a run is, after a frame.
struct Progress {
  FrameResult frame;
  int num_frames = 0;  ///< Of the sequence; 0 where its end is not known.
  double frames_per_second = 0;
};

/// "frame 100 of 300: tracking, 156 inliers, 32.1 frames/s"
std::string ProgressText(const Progress& progress);

/// The text after a bar that shows the share done, in at most `columns` characters. Without a bar
/// where the sequence's end is not known or there is no room.
std::string ProgressBar(const Progress& progress, int columns);

/// Tells on standard error how far a run is: on a terminal a bar that is drawn over, else a line
/// every 100 frames.
class ProgressReport {
 public:
  explicit ProgressReport(int num_frames);
  ~ProgressReport();
  ProgressReport(const ProgressReport&) = delete;
  ProgressReport& operator=(const ProgressReport&) = delete;

  void Add(const FrameResult& frame);

 private:
  int num_frames_;
  bool is_terminal_;
  double last_drawn_ms_ = 0;
  Stopwatch watch_;
};

}  // namespace corvo
