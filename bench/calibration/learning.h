// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/calibration/camera_run.h"
#include "bench/odometry/scenarios.h"
#include "vo/core/options.h"

namespace corvo::bench {

/// Runs on a recorded sequence from one image on, given the camera that the dataset ships.
struct LearningTrial {
  std::string scenario;
  int start = 0;                 ///< Index of the first image.
  CameraRun fixed;               ///< The given camera is fixed.
  CameraRun estimated;           ///< The camera is estimated.
  CameraRun swapped;             ///< The camera is fixed at the estimate from another sequence.
  std::vector<double> k1;        ///< k1 after each frame of the run `estimated`.
  std::vector<double> k1_sigma;  ///< Standard deviation of k1 after each frame.
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(LearningTrial, scenario, start, fixed, estimated, swapped, k1,
                                   k1_sigma)

/// Makes all runs except the swapped one. The camera's k1 is among the free parameters.
LearningTrial RunLearningTrial(const Scenario& scenario, int start, const OdometryOptions& options);

/// Runs with the camera fixed at the given one plus `difference`.
CameraRun RunSwapped(const Scenario& scenario, int start, const Eigen::VectorXd& difference,
                     const OdometryOptions& options);

/// Returns the first frame from which on all values are in [min, max], or the number of values if
/// the last one is not.
int FirstFrameWithin(const std::vector<double>& values, double min, double max);

/// Returns a Markdown table with a line for each trial: the frame from which on KITTI's k1 is in
/// [0.015, 0.032].
std::string LearningTable(const std::vector<LearningTrial>& trials);

/// Returns a Markdown table with a line for each scenario: the medians of the errors over the
/// starts, and the share of the gain that the swapped camera keeps.
std::string SwapTable(const std::vector<LearningTrial>& trials);

/// Draws k1 with a band of one standard deviation over the frames, one panel per trial. Returns
/// false if gnuplot is missing or fails.
bool DrawLearning(const std::vector<LearningTrial>& trials, const std::filesystem::path& png);

}  // namespace corvo::bench
