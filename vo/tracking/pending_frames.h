// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vo/map/frame.h"
#include "vo/map/frame_history.h"
#include "vo/map/map.h"
#include "vo/tracking/motion_model.h"
#include "vo/tracking/tracker.h"

namespace corvo {

/// A frame that was located after it had waited, with its counts.
struct LocatedFrame {
  int position = 0;  ///< In the list of frames.
  MatchCounts counts;
};

/// Locates frames that waited for a map, each from the one that was located before it.
class PendingFrameLocator {
 public:
  PendingFrameLocator(const Tracker& tracker, const MotionModel& motion, const Map& map,
                      const FrameHistory& history)
      : tracker_(tracker), motion_(motion), map_(map), history_(history) {}

  /// Locates the frames after (step 1) or before (step -1) the located one at a position, up to the
  /// next that has a pose, and returns them in this order.
  std::vector<LocatedFrame> Locate(std::vector<Frame>& frames, int located, int step) const;

 private:
  const Tracker& tracker_;
  const MotionModel& motion_;
  const Map& map_;
  const FrameHistory& history_;
};

}  // namespace corvo
