// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string_view>

#include "vo/core/trajectory.h"

namespace corvo {

/// How many of the frames that are not posed give each reason.
std::map<Reason, int> CountReasons(const Trajectory& trajectory);

/// What the user can do about frames without a pose for this reason.
std::string_view Advice(Reason reason);

}  // namespace corvo
