// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "vo/core/conventions.h"
#include "vo/lie/se3.h"
#include "vo/lie/so3.h"
#include "vo/map/frame.h"
#include "vo/map/initial_map.h"
#include "vo/tracking/motion_model.h"

namespace corvo {

// A new segment starts where the segments before ended, as far as that can be guessed: the scale of
// a monocular map is arbitrary, and poses compare only within one segment.

/// The world_from_camera at which the first frame of a segment is expected. If its rotation is
/// known it has turned so far, standing where the previous posed frame stood; otherwise it has
/// moved on at constant velocity.
SE3 PredictFirstPose(const Frame& first, const std::optional<SO3>& world_from_first_rotation,
                     const Frame& previous, const MotionModel& motion);

/// The initial map in the unit in which the camera moves on at the last known speed over the
/// baseline, which took so long. Where no speed is known the map stays as it is.
InitialMap ScaleToMotion(InitialMap map, TimeNs baseline_ns, const MotionModel& motion);

}  // namespace corvo
