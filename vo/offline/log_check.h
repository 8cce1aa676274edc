// SPDX-License-Identifier: MIT
#pragma once

#include "vo/core/trajectory.h"
#include "vo/odometry.h"
#include "vo/offline/observation_log.h"

namespace corvo {

/// Throws corvo::Error unless a log can have recorded this odometry: its frames, keyframes and
/// landmarks exist, its pixels lie in the image, and the observations of the active keyframes'
/// frames lie on their keypoints. `trajectory` is that of the odometry.
void CheckLog(const Odometry& odometry, const Trajectory& trajectory, const ObservationLog& log);

}  // namespace corvo
