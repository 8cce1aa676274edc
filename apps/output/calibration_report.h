// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "vo/odometry.h"
#include "vo/offline/refiner.h"

namespace corvo {

/// The estimate of the camera.
struct CalibrationReport {
  /// The estimate of one camera parameter.
  struct Estimate {
    std::string name;
    double given;
    double value;
    double sigma;
    double share_from_data;  ///< Fraction of its information from the images, not the prior.
    /// Whether it differs from its given value because the images are evidence against that; see
    /// FreeParameter::needs_evidence.
    bool is_contradicted = false;
  };

  std::vector<Estimate> estimates;  ///< Empty if the camera is not estimated.
  bool prior_rejected = false;      ///< See Odometry::prior_rejected().
  bool is_consistent = true;        ///< See CameraEstimate.
  CameraParameters camera;
  std::vector<FreeParameter> sigma;  ///< Standard deviations as written to camera files.
};

/// Returns the camera's estimate by the refinement if it has a covariance, otherwise by the
/// odometry.
CalibrationReport ReportCalibration(const Odometry& odometry,
                                    const std::optional<Refinement>& refinement);

/// Returns null if the camera is not estimated.
nlohmann::ordered_json ToJson(const CalibrationReport& report);

/// Returns one line, or an empty string if the camera is not estimated.
std::string ToText(const CalibrationReport& report);

}  // namespace corvo
