// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/calibration/camera_run.h"
#include "bench/calibration/sequences.h"
#include "vo/core/options.h"

namespace corvo::bench {

/// Four runs on a sequence whose camera is known exactly.
struct ConsistencyTrial {
  std::string scene;
  int seed = 0;
  std::vector<double> draw;  ///< Error of the given wrong camera.
  CameraRun fixed;           ///< The true camera is given and fixed.
  CameraRun exact;           ///< The true camera is given and estimated.
  CameraRun shipped;         ///< Like `exact`, with the sigmas of the options.
  CameraRun wrong;           ///< A wrong camera is given and estimated.
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ConsistencyTrial, scene, seed, draw, fixed, exact, shipped,
                                   wrong)

/// Runs one trial. The wrong camera differs from the true one by a draw from the prior, with
/// standard deviations of 1% of the focal length, 0.03 of k1 and 0.02 of k2. The odometry is given
/// this prior.
ConsistencyTrial RunConsistencyTrial(const ScenePart& part, const OdometryOptions& options,
                                     bool refine);

/// Returns Markdown tables: the consistency of the standard deviations and the effect on the ATE,
/// by scene and over all, and the estimates in scenes that hardly constrain the camera.
std::string ConsistencyTables(const std::vector<ConsistencyTrial>& trials, bool refined);

}  // namespace corvo::bench
