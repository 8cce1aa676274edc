// SPDX-License-Identifier: MIT
#pragma once

#include "vo/core/frame_result.h"
#include "vo/map/frame_history.h"
#include "vo/tracking/initializer.h"
#include "vo/tracking/tracker.h"

namespace corvo {

/// Sets the state of a frame without a pose, and the reason and counts: those of the initializer
/// while there is no map, those of the tracker afterwards. Too few features are the reason in both
/// cases.
void ExplainUnposed(bool has_map, const TrackingResult& tracking,
                    const InitializationResult& initialization, FrameOutcome& outcome);

/// Records the rotation of a frame without a pose relative to the frame that the initializer names.
/// The reference frame of a sequence that `is_first` starts a chain. Returns whether the frame's
/// rotation is known from a relative rotation.
bool ChainRotation(int frame, const InitializationResult& initialization, bool is_first,
                   const Map& map, FrameHistory& history);

}  // namespace corvo
