#include <exception>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "apps/environment.h"
#include "bench/calibration/honesty.h"
#include "bench/odometry/child_process.h"
#include "vo/config.h"

namespace corvo::bench {
namespace {

struct Arguments {
  std::string config;
  std::string json;
  int jobs = 2;
  int runs = 100;
  int blind_runs = 10;
  bool refine = false;
};

/// In children; their results in the order of the tasks.
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

std::vector<HonestyTrial> RunHonestyTrials(const Arguments& arguments,
                                           const OdometryOptions& options) {
  std::vector<std::function<HonestyTrial()>> tasks;
  const auto add = [&](FilmScene scene, int seed) {
    tasks.push_back([=] { return RunHonestyTrial(scene, seed, options, arguments.refine); });
  };
  for (int seed = 0; seed < arguments.runs; ++seed) {
    add(seed % 2 == 0 ? FilmScene::kStreet : FilmScene::kRoom, seed);
  }
  for (int seed = 0; seed < arguments.blind_runs; ++seed) {
    add(FilmScene::kStraight, seed);
    add(FilmScene::kRotation, seed);
  }
  return RunAll(tasks, arguments.jobs);
}

void AddOptions(CLI::App& app, Arguments& arguments) {
  app.add_option("--config", arguments.config, "options file instead of the defaults");
  app.add_option("--json", arguments.json, "where every figure is written");
  app.add_option("--jobs", arguments.jobs, "trials at once")->check(CLI::Range(1, 1024));
  app.add_option("--runs", arguments.runs, "of a street and a room, in turn")
      ->check(CLI::Range(0, 100'000));
  app.add_option("--blind-runs", arguments.blind_runs, "of either scene that tells nothing")
      ->check(CLI::Range(0, 100'000));
  app.add_flag("--refine", arguments.refine, "cameras as they are after refinement");
}

int Main(int argc, char** argv) {
  CLI::App app("How honest, how soon and how useful corvo's estimate of the camera is.");
  Arguments arguments;
  AddOptions(app, arguments);
  CLI11_PARSE(app, argc, argv);
  const OdometryOptions options =
      arguments.config.empty() ? OdometryOptions() : ReadOptions(arguments.config);
  nlohmann::json json{{"environment", DescribeMachine()}};
  const std::vector<HonestyTrial> honesty = RunHonestyTrials(arguments, options);
  json["honesty"] = honesty;
  fmt::print("{}", HonestyTables(honesty));
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
