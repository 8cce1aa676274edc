// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/calibration/camera_run.h"
#include "bench/calibration/sequences.h"
#include "vo/core/options.h"

namespace corvo::bench {

/// A film with a camera that is known exactly, run four times.
struct ConsistencyTrial {
  std::string scene;
  int seed = 0;
  std::vector<double> draw;  ///< By which the camera that is given is wrong.
  CameraRun fixed;           ///< The true camera, as it is.
  CameraRun exact;           ///< The true camera is given, and estimated.
  CameraRun shipped;         ///< The same, with the sigmas of the options.
  CameraRun wrong;           ///< A wrong camera is given, and estimated.
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ConsistencyTrial, scene, seed, draw, fixed, exact, shipped,
                                   wrong)

/// The wrong camera misses the true one by a draw from the prior: 1% of the focal length, 0.03 of
/// k1 and 0.02 of k2, standard deviations, which the odometry is told.
ConsistencyTrial RunConsistencyTrial(RenderScene scene, int seed, const OdometryOptions& options,
                                     bool refine);

/// Markdown: whether sigmas are consistent and what that gives, scene by scene and over all; what
/// comes out where little or nothing tells the camera.
std::string ConsistencyTables(const std::vector<ConsistencyTrial>& trials, bool refined);

}  // namespace corvo::bench
