// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/calibration/camera_run.h"
#include "bench/odometry/perturbation.h"
#include "bench/odometry/scenarios.h"
#include "vo/core/options.h"

namespace corvo::bench {

/// A recorded sequence under a perturbation, its camera given as the dataset ships it.
struct LearningTrial {
  std::string scenario;
  std::string perturbation;
  bool is_judged = true;
  CameraRun fixed;               ///< The camera is taken as it is given.
  CameraRun estimated;           ///< It is estimated.
  CameraRun swapped;             ///< It is fixed as another sequence of it has estimated it.
  std::vector<double> k1;        ///< After each frame, of the estimated run.
  std::vector<double> k1_sigma;  ///< Likewise, its standard deviation.
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(LearningTrial, scenario, perturbation, is_judged, fixed,
                                   estimated, swapped, k1, k1_sigma)

/// All but the swapped run. The camera's k1 is among what is free.
LearningTrial RunLearningTrial(const Scenario& scenario, const Perturbation& perturbation,
                               const OdometryOptions& options);

/// With the camera that is given, moved by a difference from it, fixed.
CameraRun RunSwapped(const Scenario& scenario, const Perturbation& perturbation,
                     const Eigen::VectorXd& difference, const OdometryOptions& options);

/// The frame from which on all values lie in [min, max]; their number if the last one does not.
int FirstFrameWithin(const std::vector<double>& values, double min, double max);

/// A Markdown table with a line for each trial: from which frame on KITTI's k1 lies in [0.015,
/// 0.032].
std::string LearningTable(const std::vector<LearningTrial>& trials);

/// A Markdown table with a line for each scenario: medians over the judged perturbations of the
/// errors, and what the swapped camera keeps of the gain.
std::string SwapTable(const std::vector<LearningTrial>& trials);

/// Draws k1 with a band of one standard deviation over the frames, a panel a trial. False where
/// gnuplot is missing or fails.
bool DrawLearning(const std::vector<LearningTrial>& trials, const std::filesystem::path& png);

}  // namespace corvo::bench
