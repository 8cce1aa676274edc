// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "vo/core/trajectory.h"

namespace corvo {

/// Returns why a trajectory cannot be written in KITTI format, which has one row per frame, all in
/// one world frame. Empty if it can be written.
std::string WhyNotKitti(const Trajectory& trajectory);

/// Returns the pose of every frame. Requires that WhyNotKitti() returns an empty string.
std::vector<SE3> KittiRows(const Trajectory& trajectory);

}  // namespace corvo
