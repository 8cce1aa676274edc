// SPDX-License-Identifier: MIT
#include <algorithm>
#include <exception>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "apps/output/environment.h"
#include "bench/calibration/consistency.h"
#include "bench/calibration/learning.h"
#include "bench/odometry/child_process.h"
#include "bench/odometry/scenarios.h"
#include "orb/error.h"
#include "vo/io/config.h"

namespace corvo::bench {
namespace {

struct Arguments {
  std::string config;
  std::string json;
  std::string plot;
  int jobs = 2;
  int runs = 100;
  int blind_runs = 10;
  int frames = ScenePart().frames;
  bool rendered = false;
  bool recorded = false;
  bool refine = false;
};

/// Runs the tasks in child processes and returns their results in the order of the tasks.
template <typename Result>
std::vector<Result> RunAll(const std::vector<std::function<Result()>>& tasks, int jobs) {
  std::vector<Result> results(tasks.size());
  std::vector<std::function<std::string()>> in_bytes;
  for (const auto& task : tasks) in_bytes.push_back([&task] { return ToBytes(task()); });
  int num_done = 0;
  RunInChildren(in_bytes, jobs, [&](int task, const ChildOutcome& outcome) {
    results[task] = FromBytes<Result>(outcome.output);
    fmt::print(stderr, "\r{} of {}", ++num_done, tasks.size());
  });
  fmt::print(stderr, "\n");
  return results;
}

std::vector<ConsistencyTrial> RunConsistencyTrials(const Arguments& arguments,
                                                   const OdometryOptions& options) {
  std::vector<std::function<ConsistencyTrial()>> tasks;
  const auto add = [&](RenderScene scene, int seed) {
    tasks.push_back([=] {
      return RunConsistencyTrial({scene, seed, arguments.frames}, options, arguments.refine);
    });
  };
  for (int seed = 0; seed < arguments.runs; ++seed) {
    add(seed % 2 == 0 ? RenderScene::kStreet : RenderScene::kRoom, seed);
  }
  for (int seed = 0; seed < arguments.blind_runs; ++seed) {
    add(RenderScene::kStraight, seed);
    add(RenderScene::kRotation, seed);
  }
  return RunAll(tasks, arguments.jobs);
}

/// The titles of the two scenarios that swap cameras: each runs with the other's estimate.
const std::vector<std::string> kSwapped = {"KITTI 03, nominal", "KITTI 05, nominal"};
const std::string kStraightOn = "KITTI 06, nominal";  ///< A straight drive: one start only.

bool IsLearnt(const Scenario& scenario) {
  return std::find(kSwapped.begin(), kSwapped.end(), scenario.title) != kSwapped.end() ||
         scenario.title == kStraightOn;
}

struct Case {
  Scenario scenario;
  int start = 0;
};

std::vector<Case> LearningCases() {
  std::vector<Case> cases;
  for (const Scenario& scenario : RecordedScenarios()) {
    if (!IsLearnt(scenario)) continue;
    for (const int start : scenario.starts) {
      if (scenario.title != kStraightOn || start == 0) cases.push_back({scenario, start});
    }
  }
  return cases;
}

/// Returns the trial of the other scenario from the same image on, or null if there is none.
const LearningTrial* FindOther(const LearningTrial& trial,
                               const std::vector<LearningTrial>& trials) {
  if (trial.scenario == kStraightOn) return nullptr;
  for (const LearningTrial& other : trials) {
    if (other.scenario != trial.scenario && other.scenario != kStraightOn &&
        other.start == trial.start) {
      return &other;
    }
  }
  return nullptr;
}

std::vector<LearningTrial> RunLearningTrials(const Arguments& arguments,
                                             const OdometryOptions& options) {
  const std::vector<Case> cases = LearningCases();
  std::vector<std::function<LearningTrial()>> tasks;
  for (const Case& each : cases) {
    tasks.push_back([&] { return RunLearningTrial(each.scenario, each.start, options); });
  }
  std::vector<LearningTrial> trials = RunAll(tasks, arguments.jobs);
  std::vector<std::function<CameraRun()>> swaps;
  std::vector<CameraRun*> swapped;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const LearningTrial* other = FindOther(trials[i], trials);
    if (other == nullptr) continue;
    swapped.push_back(&trials[i].swapped);
    swaps.push_back([&each = cases[i], &options, other] {
      return RunSwapped(each.scenario, each.start, other->estimated.estimate.difference, options);
    });
  }
  const std::vector<CameraRun> runs = RunAll(swaps, arguments.jobs);
  for (std::size_t i = 0; i < runs.size(); ++i) *swapped[i] = runs[i];
  return trials;
}

/// Draws k1 of the sequences from their first images on.
void Plot(const std::vector<LearningTrial>& trials, const std::string& file) {
  std::vector<LearningTrial> drawn;
  for (const LearningTrial& trial : trials) {
    if (trial.start == 0) drawn.push_back(trial);
  }
  if (!DrawLearning(drawn, file)) throw Error(file + ": gnuplot is missing or fails");
}

void AddOptions(CLI::App& app, Arguments& arguments) {
  app.add_option("--config", arguments.config, "options file instead of the defaults");
  app.add_option("--json", arguments.json, "where every figure is written");
  app.add_option("--plot", arguments.plot, "where an image of k1 over the frames is written");
  app.add_option("--jobs", arguments.jobs, "trials at once")->check(CLI::Range(1, 1024));
  app.add_flag("--rendered", arguments.rendered, "rendered scenes alone");
  app.add_flag("--recorded", arguments.recorded, "recorded sequences alone");
  app.add_option("--runs", arguments.runs, "of a rendered street and a room, in turn")
      ->check(CLI::Range(0, 100'000));
  app.add_option("--blind-runs", arguments.blind_runs, "of either scene that tells nothing")
      ->check(CLI::Range(0, 100'000));
  app.add_option("--frames", arguments.frames, "of a rendered sequence")
      ->check(CLI::Range(2, 100'000));
  app.add_flag("--refine", arguments.refine, "also rendered scenes after refinement");
}

int Main(int argc, char** argv) {
  CLI::App app("How consistent, how soon and how useful corvo's estimate of the camera is.");
  Arguments arguments;
  AddOptions(app, arguments);
  CLI11_PARSE(app, argc, argv);
  const OdometryOptions options =
      arguments.config.empty() ? OdometryOptions() : ReadOptions(arguments.config);
  nlohmann::json json{{"environment", DescribeMachine()}};
  if (arguments.rendered || !arguments.recorded) {
    const std::vector<ConsistencyTrial> trials = RunConsistencyTrials(arguments, options);
    json["consistency"] = trials;
    fmt::print("{}\n", ConsistencyTables(trials, arguments.refine));
  }
  if (arguments.recorded || !arguments.rendered) {
    const std::vector<LearningTrial> trials = RunLearningTrials(arguments, options);
    json["learning"] = trials;
    fmt::print("{}\n{}", LearningTable(trials), SwapTable(trials));
    if (!arguments.plot.empty()) Plot(trials, arguments.plot);
  }
  if (!arguments.json.empty()) std::ofstream(arguments.json) << json.dump(1) << '\n';
  return 0;
}

}  // namespace
}  // namespace corvo::bench

int main(int argc, char** argv) {
  try {
    return corvo::bench::Main(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "corvo_calibration_bench: {}\n", error.what());
    return 1;
  }
}
