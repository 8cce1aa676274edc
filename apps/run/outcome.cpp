// SPDX-License-Identifier: MIT
#include "apps/run/outcome.h"

#include <algorithm>

namespace corvo {

int CountPosedSegments(const Trajectory& trajectory) {
  return static_cast<int>(trajectory.Segments().size());
}

int CountPosedFrames(const Trajectory& trajectory) {
  return static_cast<int>(
      std::count_if(trajectory.frames.begin(), trajectory.frames.end(),
                    [](const FrameResult& frame) { return frame.world_from_camera.has_value(); }));
}

Outcome JudgeOutcome(const Trajectory& trajectory) {
  const int segments = CountPosedSegments(trajectory);
  if (segments == 0) return Outcome::kNeverInitialized;
  const auto is_posed = [](const FrameResult& frame) {
    return frame.world_from_camera.has_value();
  };
  const auto first = std::find_if(trajectory.frames.begin(), trajectory.frames.end(), is_posed);
  const bool lost = std::any_of(first, trajectory.frames.end(), [&](const FrameResult& frame) {
    return !is_posed(frame) && !IsMissingImage(frame.reason);
  });
  return lost || segments > 1 ? Outcome::kLost : Outcome::kDone;
}

std::string_view ToString(Outcome outcome) {
  switch (outcome) {
    case Outcome::kDone:
      return "done";
    case Outcome::kNeverInitialized:
      return "never initialized";
    case Outcome::kLost:
      return "lost part-way";
  }
  return "";
}

}  // namespace corvo
