// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "vo/core/trajectory.h"

namespace corvo {

/// Returns the poses of a segment.
PoseSequence PosesOf(const Segment& segment, const Trajectory& trajectory);

/// Returns the index, the frames, the number of poses and the origin of the scale of a segment in
/// one line.
std::string ToText(const Segment& segment);

/// Returns an array with an object for each segment. `factor` is null if the scale is arbitrary.
nlohmann::ordered_json ToJson(const std::vector<Segment>& segments);

}  // namespace corvo
