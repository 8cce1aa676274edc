// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "vo/odometry.h"
#include "vo/offline/refiner.h"

namespace corvo {

/// What became known of the camera.
struct CalibrationReport {
  /// One number of a camera.
  struct Estimate {
    std::string name;
    double given;
    double value;
    double sigma;
    double share_from_data;  ///< Of the information about it; the rest was known before.
  };

  std::vector<Estimate> estimates;  ///< Empty where the camera is not estimated.
  bool prior_rejected = false;      ///< As Odometry::prior_rejected().
  CameraParameters camera;
  std::vector<FreeParameter> sigma;  ///< As camera files have it.
};

/// By the refinement, where there is one that lowered the cost.
CalibrationReport ReportCalibration(const Odometry& odometry,
                                    const std::optional<Refinement>& refinement);

/// null where the camera is not estimated.
nlohmann::ordered_json ToJson(const CalibrationReport& report);

/// A line; empty where the camera is not estimated.
std::string ToText(const CalibrationReport& report);

/// Warns where the images contradict the camera that was given.
void WarnOfContradiction(const CalibrationReport& report);

}  // namespace corvo
