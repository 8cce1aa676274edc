#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "vo/odometry.h"

namespace corvo {

/// Each estimated number with the value given, its standard deviation and the share of its
/// information that came from the pictures (the rest is what was known before); null where the
/// camera is not estimated.
nlohmann::ordered_json CalibrationJson(const Odometry& odometry);

/// The same in a line; empty where the camera is not estimated.
std::string CalibrationText(const Odometry& odometry);

/// Warns where the pictures contradict the camera that was given.
void WarnOfContradiction(const Odometry& odometry);

}  // namespace corvo
