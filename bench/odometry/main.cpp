// SPDX-License-Identifier: MIT
#include <cstdio>
#include <cstring>
#include <exception>
#include <fstream>
#include <numeric>
#include <regex>
#include <string>
#include <type_traits>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "apps/output/environment.h"
#include "bench/odometry/child_process.h"
#include "bench/odometry/cost.h"
#include "bench/odometry/endurance.h"
#include "bench/odometry/option_setting.h"
#include "bench/odometry/report.h"
#include "bench/odometry/scenarios.h"
#include "vo/io/config.h"

namespace corvo::bench {
namespace {

struct Arguments {
  std::string scenarios;
  std::string config;
  std::vector<std::string> settings;
  std::string json;
  int jobs = 2;
  int num_starts = 0;
  int endurance_frames = 0;
  bool rendered = false;
  bool cost = false;
  bool details = false;
  bool refine = false;
};

/// Serializes a result for the pipe between a process and its child.
template <typename Result>
std::string ToBytes(const Result& result) {
  static_assert(std::is_trivially_copyable_v<Result>);
  return {reinterpret_cast<const char*>(&result), sizeof result};
}

template <typename Result>
Result FromBytes(const std::string& bytes) {
  Result result;
  std::memcpy(&result, bytes.data(), sizeof result);
  return result;
}

std::vector<Scenario> SelectScenarios(const Arguments& arguments) {
  std::vector<Scenario> selected;
  for (const auto& scenarios : {RecordedScenarios(), RenderedScenarios()}) {
    for (const Scenario& scenario : scenarios) {
      if (!std::regex_search(scenario.title, std::regex(arguments.scenarios))) continue;
      const bool is_rendered = scenario.title.rfind("rendered", 0) == 0;
      if (!arguments.rendered && is_rendered) continue;
      selected.push_back(scenario);
      if (arguments.num_starts == 0) continue;
      selected.back().starts.resize(arguments.num_starts);
      std::iota(selected.back().starts.begin(), selected.back().starts.end(), 0);
    }
  }
  return selected;
}

std::vector<Trial> RunTrials(const std::vector<Scenario>& scenarios, const Arguments& arguments,
                             const OdometryOptions& options) {
  std::vector<Trial> trials;
  std::vector<std::function<std::string()>> tasks;
  for (const Scenario& scenario : scenarios) {
    for (const int start : scenario.starts) {
      trials.push_back({scenario.title, start, {}});
      tasks.push_back([make = scenario.make, start, options, refine = arguments.refine] {
        return ToBytes(RunTrial(StartAt(make(), start), options, refine));
      });
    }
  }
  int num_done = 0;
  RunInChildren(tasks, arguments.jobs, [&](int task, const ChildOutcome& outcome) {
    trials[task].result = FromBytes<TrialResult>(outcome.output);
    trials[task].result.peak_memory_mb = outcome.peak_memory_mb;
    fmt::print(stderr, "\r{} of {}", ++num_done, tasks.size());
  });
  fmt::print(stderr, "\n");
  return trials;
}

/// Prints the costs on the sequences that represent their image sizes.
void PrintCosts(const OdometryOptions& options) {
  constexpr int kRepeats = 3;
  std::vector<Scenario> scenarios;
  std::vector<std::function<std::string()>> tasks;
  for (const Scenario& scenario : RecordedScenarios()) {
    if (scenario.title != "KITTI 03, nominal" && scenario.title != "7-Scenes redkitchen") continue;
    scenarios.push_back(scenario);
    tasks.push_back(
        [scenario, options] { return ToBytes(MeasureCost(scenario.make(), options, kRepeats)); });
  }
  fmt::print(
      "| cost | keypoints | processor, ms a frame | cv::ORB, ms | ratio | Process, median ms | "
      "p99, ms | p99 / median |\n|---|---|---|---|---|---|---|---|\n");
  RunInChildren(tasks, 1, [&](int task, const ChildOutcome& outcome) {
    const auto cost = FromBytes<Cost>(outcome.output);
    fmt::print("| {} | {} | {:.1f} | {:.1f} | {:.2f}x | {:.1f} | {:.1f} | {:.2f}x |\n",
               scenarios[task].title, cost.keypoints, cost.odometry_ms, cost.orb_ms, cost.ratio,
               cost.median_ms, cost.p99_ms, cost.p99_ms / cost.median_ms);
  });
}

/// Prints the memory use after a tenth, a quarter, half and all of the frames.
void PrintEndurance(const Arguments& arguments, const OdometryOptions& options) {
  const int frames = arguments.endurance_frames;
  fmt::print("{}", HoldingHead());
  for (const Scenario& scenario : EnduranceScenarios(frames)) {
    if (!std::regex_search(scenario.title, std::regex(arguments.scenarios))) continue;
    MeasureHoldings(scenario.make(), options, {frames / 10, frames / 4, frames / 2, frames},
                    [&](const Holding& holding) {
                      fmt::print("{}", HoldingLine(scenario.title, holding));
                      std::fflush(stdout);
                    });
  }
}

OdometryOptions MakeOptions(const Arguments& arguments) {
  OdometryOptions options =
      arguments.config.empty() ? OdometryOptions() : ReadOptions(arguments.config);
  for (const std::string& setting : arguments.settings) SetOption(setting, options);
  return options;
}

void AddOptions(CLI::App& app, Arguments& arguments) {
  app.add_option("--scenarios", arguments.scenarios, "those whose title matches this expression");
  app.add_option("--starts", arguments.num_starts,
                 "begin at each of so many first images instead of five of them")
      ->check(CLI::Range(1, 1000));
  app.add_option("--config", arguments.config, "options file instead of the defaults");
  app.add_option("--set", arguments.settings,
                 "SECTION.FIELD=VALUE, also of options that files do not have; repeatable");
  app.add_option("--json", arguments.json, "where every figure is written");
  app.add_option("--jobs", arguments.jobs, "trials at once")->check(CLI::Range(1, 1024));
  app.add_flag("--rendered", arguments.rendered, "also the rendered scenarios; they take minutes");
  app.add_flag("--cost", arguments.cost, "processor time against cv::ORB instead");
  app.add_option(
         "--endurance", arguments.endurance_frames,
         "memory held over so many frames of scenes without an end instead; 20000 take long")
      ->check(CLI::Range(10, 10'000'000));
  app.add_flag("--refine", arguments.refine, "trajectories refined after the last frame");
  app.add_flag("--details", arguments.details, "a line for each trial, too");
}

void WriteJson(const std::string& file, const std::vector<Trial>& trials) {
  std::ofstream(file) << nlohmann::ordered_json{{"environment", DescribeMachine()},
                                                {"trials", ToJson(trials)}}
                             .dump(2)
                      << '\n';
}

int Main(int argc, char** argv) {
  CLI::App app("Accuracy, completeness and cost of corvo's odometry from several first images.");
  Arguments arguments;
  AddOptions(app, arguments);
  CLI11_PARSE(app, argc, argv);
  const OdometryOptions options = MakeOptions(arguments);
  if (arguments.cost) {
    PrintCosts(options);
    return 0;
  }
  if (arguments.endurance_frames > 0) {
    PrintEndurance(arguments, options);
    return 0;
  }
  const std::vector<Trial> trials = RunTrials(SelectScenarios(arguments), arguments, options);
  if (arguments.details) fmt::print("{}\n", TrialTable(trials));
  fmt::print("{}", SummaryTable(trials));
  if (!arguments.json.empty()) WriteJson(arguments.json, trials);
  return 0;
}

}  // namespace
}  // namespace corvo::bench

int main(int argc, char** argv) {
  try {
    return corvo::bench::Main(argc, argv);
  } catch (const std::exception& error) {
    fmt::print(stderr, "corvo_odometry_bench: {}\n", error.what());
    return 1;
  }
}
