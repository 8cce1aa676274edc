// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string_view>

#include "vo/core/trajectory.h"

namespace corvo {

/// Returns the number of frames without a pose for each reason.
std::map<Reason, int> CountReasons(const Trajectory& trajectory);

/// Returns an explanation of frames without a pose for this reason and what the user can do about
/// it.
std::string_view Advice(Reason reason);

}  // namespace corvo
