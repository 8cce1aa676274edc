// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "vo/core/conventions.h"

namespace corvo {

/// The file of times in each sensor's folder of a drive of KITTI's raw data.
inline constexpr const char* kKittiRawTimes = "timestamps.txt";

/// Reads lines like "2011-09-26 13:02:25.964389445". The times count from 1970 as if the clock were
/// that of UTC. Throws corvo::Error with file and line if a line is not a date and time of day.
std::vector<TimeNs> ReadKittiRawTimes(const std::filesystem::path& file);

}  // namespace corvo
