// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "vo/core/conventions.h"
#include "vo/core/segment.h"
#include "vo/lie/se3.h"
#include "vo/lie/so3.h"
#include "vo/map/frame.h"
#include "vo/map/initial_map.h"
#include "vo/tracking/motion_model.h"
#include "vo/tracking/speed_history.h"

namespace corvo {

// A new segment starts at an extrapolation of the previous ones: the scale of a monocular map is
// arbitrary, and poses can be compared only within one segment.

/// Returns the expected world_from_camera of the first frame of a segment. If the frame's rotation
/// is known, it has the position of the previous posed frame; otherwise the camera has moved on at
/// constant velocity.
SE3 PredictFirstPose(const Frame& first, const std::optional<SO3>& world_from_first_rotation,
                     const Frame& previous, const MotionModel& motion);

/// Returns the initial map scaled so that the camera moves at the guessed speed over the baseline,
/// which took `baseline_ns`. Returns the map unchanged if there is no guess.
InitialMap ScaleToSpeed(InitialMap map, TimeNs baseline_ns, const std::optional<SpeedGuess>& speed);

/// Returns the origin of the scale of a map that was scaled by ScaleToSpeed(), with the factor
/// exp(log_sigma) of the guess.
SegmentScale ScaleOf(const std::optional<SpeedGuess>& speed);

}  // namespace corvo
