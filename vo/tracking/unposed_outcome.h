// SPDX-License-Identifier: MIT
#pragma once

#include "vo/core/frame_result.h"
#include "vo/tracking/initializer.h"
#include "vo/tracking/tracker.h"

namespace corvo {

/// Sets why a frame has no pose, and the counts behind it: as the initializer says while there is
/// no map, as the tracker says once there is one. A blank image is one in both.
void ExplainUnposed(bool has_map, const TrackingResult& tracking,
                    const InitializationResult& initialization, FrameOutcome& outcome);

}  // namespace corvo
