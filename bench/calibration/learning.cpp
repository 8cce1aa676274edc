// SPDX-License-Identifier: MIT
#include "bench/calibration/learning.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "apps/output/gnuplot.h"
#include "vo/math/percentile.h"

namespace corvo::bench {
namespace {

constexpr double kMinK1 = 0.015, kMaxK1 = 0.032;  ///< Range of k1 on KITTI's rectified images.

/// Returns the frame from which k1 must be known, or 0 if the scenario has no requirement.
int RequiredFrame(const std::string& scenario) {
  if (scenario == "KITTI 03, nominal") return 120;
  return scenario == "KITTI 05, nominal" ? 40 : 0;
}

Eigen::Index IndexOfK1(const CameraPrior& prior) {
  const auto found = std::find_if(prior.free.begin(), prior.free.end(),
                                  [](const FreeParameter& free) { return free.name == "k1"; });
  return found - prior.free.begin();
}

/// Returns the range of the values from a frame on, such as "0.0172 - 0.0263".
std::string RangeFrom(const std::vector<double>& values, int frame) {
  if (frame >= static_cast<int>(values.size())) return "-";
  const auto [min, max] = std::minmax_element(values.begin() + frame, values.end());
  return fmt::format("{:.4f} - {:.4f}", *min, *max);
}

std::vector<std::string> ScenariosOf(const std::vector<LearningTrial>& trials) {
  std::vector<std::string> scenarios;
  for (const LearningTrial& trial : trials) {
    if (scenarios.empty() || scenarios.back() != trial.scenario) {
      scenarios.push_back(trial.scenario);
    }
  }
  return scenarios;
}

std::string SwapLine(const std::string& scenario, const std::vector<LearningTrial>& trials) {
  std::vector<double> fixed, estimated, swapped, kept;
  for (const LearningTrial& trial : trials) {
    if (trial.scenario != scenario || std::isnan(trial.swapped.ate)) continue;
    fixed.push_back(trial.fixed.ate);
    estimated.push_back(trial.estimated.ate);
    swapped.push_back(trial.swapped.ate);
    kept.push_back((fixed.back() - swapped.back()) / (fixed.back() - estimated.back()));
  }
  if (fixed.empty()) return "";
  return fmt::format("| {} | {} | {:.4f} | {:.4f} | {:.4f} | {:.0f} ({:.0f}) |\n", scenario,
                     fixed.size(), Percentile(fixed, 50), Percentile(estimated, 50),
                     Percentile(swapped, 50), 100 * Percentile(kept, 50),
                     100 * Percentile(kept, 0));
}

std::string DataBlock(int index, const LearningTrial& trial) {
  std::string block = fmt::format("$trial{} << EOD\n", index);
  for (std::size_t i = 0; i < trial.k1.size(); ++i) {
    block += fmt::format("{} {:.6f} {:.6f} {:.6f}\n", i, trial.k1[i],
                         trial.k1[i] - trial.k1_sigma[i], trial.k1[i] + trial.k1_sigma[i]);
  }
  return block + "EOD\n";
}

std::string Panel(int index, const LearningTrial& trial) {
  return fmt::format(
      "set title '{1}'\nplot $trial{0} using 1:3:4 with filledcurves lc rgb '#c6d8ee' title "
      "'k1 ± sigma', '' using 1:2 with steps lw 2 lc rgb '#1f4e89' title 'k1'\n",
      index, trial.scenario);
}

}  // namespace

LearningTrial RunLearningTrial(const Scenario& scenario, int start,
                               const OdometryOptions& options) {
  const Recording recording = StartAt(scenario.make(), start);
  const CameraPrior prior = MakePrior(recording.camera.parameters(), options.calibration);
  const Eigen::Index k1 = IndexOfK1(prior);
  LearningTrial trial;
  trial.scenario = scenario.title;
  trial.start = start;
  trial.fixed = RunWithCamera(recording, {prior.given, {}}, options);
  trial.estimated = RunWithCamera(recording, prior, options, false, [&](const Odometry& odometry) {
    const CameraEstimate& estimate = odometry.camera_estimate();
    trial.k1.push_back(prior.given.k1 + estimate.difference[k1]);
    trial.k1_sigma.push_back(std::sqrt(estimate.covariance(k1, k1)));
  });
  trial.swapped.ate = std::numeric_limits<double>::quiet_NaN();
  return trial;
}

CameraRun RunSwapped(const Scenario& scenario, int start, const Eigen::VectorXd& difference,
                     const OdometryOptions& options) {
  const Recording recording = StartAt(scenario.make(), start);
  const CameraPrior prior = MakePrior(recording.camera.parameters(), options.calibration);
  return RunWithCamera(recording, {prior.Apply(difference), {}}, options);
}

int FirstFrameWithin(const std::vector<double>& values, double min, double max) {
  int first = static_cast<int>(values.size());
  while (first > 0 && values[first - 1] >= min && values[first - 1] <= max) --first;
  return first;
}

std::string LearningTable(const std::vector<LearningTrial>& trials) {
  std::string table = fmt::format(
      "| scenario | start | frames | k1 in {} - {} from frame | asked for | k1 from there "
      "on | k1 at the end |\n|---|---|---|---|---|---|---|\n",
      kMinK1, kMaxK1);
  for (const LearningTrial& trial : trials) {
    const int first = FirstFrameWithin(trial.k1, kMinK1, kMaxK1);
    const int required = RequiredFrame(trial.scenario);
    const int num_frames = static_cast<int>(trial.k1.size());
    table += fmt::format("| {} | {} | {} | {} | {} | {} | {:.4f} ± {:.4f} |\n", trial.scenario,
                         trial.start, num_frames, first < num_frames ? std::to_string(first) : "-",
                         required > 0 ? std::to_string(required) : "-",
                         RangeFrom(trial.k1, required), trial.k1.back(), trial.k1_sigma.back());
  }
  return table;
}

std::string SwapTable(const std::vector<LearningTrial>& trials) {
  std::string table =
      "| ATE, m, median | runs | camera as shipped | estimated | the other's estimate | gain kept, "
      "median (least), % |\n|---|---|---|---|---|---|\n";
  for (const std::string& scenario : ScenariosOf(trials)) table += SwapLine(scenario, trials);
  return table;
}

bool DrawLearning(const std::vector<LearningTrial>& trials, const std::filesystem::path& png) {
  std::string script = fmt::format(
      "set terminal pngcairo size {},360\nset grid\nset xlabel 'frame'\nset yrange [-0.03:0.06]\n"
      "set key top right\n",
      400 * trials.size());
  const int num_trials = static_cast<int>(trials.size());
  for (int i = 0; i < num_trials; ++i) script += DataBlock(i, trials[i]);
  script += fmt::format("set multiplot layout 1,{}\n", num_trials);
  for (int i = 0; i < num_trials; ++i) script += Panel(i, trials[i]);
  return RunGnuplot(script + "unset multiplot\n", png);
}

}  // namespace corvo::bench
