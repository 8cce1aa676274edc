// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "vo/core/trajectory.h"

namespace corvo {

/// Why a trajectory cannot be written in KITTI format, which has a row for every frame, all in one
/// world; empty where it can.
std::string WhyNotKitti(const Trajectory& trajectory);

/// The pose of every frame. Only for trajectories with nothing against it.
std::vector<SE3> KittiRows(const Trajectory& trajectory);

}  // namespace corvo
