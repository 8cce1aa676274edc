// SPDX-License-Identifier: MIT
#include "vo/tracking/pending_frames.h"

namespace corvo {

std::vector<LocatedFrame> PendingFrameLocator::Locate(std::vector<Frame>& frames, int located,
                                                      int step) const {
  std::vector<LocatedFrame> all;
  const int num_frames = static_cast<int>(frames.size());
  for (int i = located + step; i >= 0 && i < num_frames; i += step) {
    Frame& frame = frames[i];
    if (history_.IsPosed(frame.index)) break;
    const TrackingResult tracking = tracker_.Track(
        map_, frames[located], motion_.PredictAlternatives(frames[located], frame.time_ns), frame);
    if (!tracking.is_tracked()) continue;
    all.push_back({i, {tracking.num_matches, tracking.num_inliers}});
    located = i;
  }
  return all;
}

}  // namespace corvo
