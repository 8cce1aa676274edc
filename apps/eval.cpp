#include "apps/eval.h"

#include <cmath>
#include <filesystem>
#include <memory>
#include <string>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "apps/evaluation_report.h"
#include "apps/plot.h"
#include "apps/pose_file.h"
#include "orb/error.h"
#include "vo/trajectory_io.h"

namespace corvo {
namespace {

constexpr const char* kFooter = R"(Examples:
  corvo eval result/trajectory.tum groundtruth.txt
  corvo eval result/trajectory.tum poses/03.txt --times sequences/03/times.txt
  corvo eval estimate.txt truth.txt --align se3 --max-dt 0.01 --plot error.png

EST and GT are in TUM format (8 columns: seconds, position, quaternion) or KITTI format (12 columns,
no times). Two KITTI files are compared row by row. --align sim3 is for monocular trajectories.)";

struct EvalArguments {
  std::filesystem::path estimate;
  std::filesystem::path truth;
  std::filesystem::path times;  ///< Of the rows of a file in KITTI format.
  std::filesystem::path picture;
  std::string alignment = "sim3";
  double max_dt_s = 0.02;
  bool json = false;
};

struct EvalInputs {
  PoseSequence estimate;
  PoseSequence truth;
};

/// The poses of a file, with the times of --times where it has none of its own.
PoseSequence PosesWithTimes(const PoseFile& poses, const EvalArguments& arguments) {
  if (poses.has_times() || arguments.times.empty()) return poses.poses();
  const std::vector<TimeNs> times = ReadKittiTimes(arguments.times);
  if (poses.size() > times.size()) {
    throw Error(fmt::format("{}: {} times for {} poses", arguments.times.string(), times.size(),
                            poses.size()));
  }
  return poses.WithTimes(times);
}

EvalInputs ReadEvalInputs(const EvalArguments& arguments) {
  const PoseFile estimate = ReadPoseFile(arguments.estimate);
  const PoseFile truth = ReadPoseFile(arguments.truth);
  if (estimate.has_times() != truth.has_times() && arguments.times.empty()) {
    const std::filesystem::path& without =
        estimate.has_times() ? arguments.truth : arguments.estimate;
    throw Error(
        fmt::format("{}: KITTI format has no times; give --times FILE with the time of "
                    "each row (the sequence's times.txt)",
                    without.string()));
  }
  return {PosesWithTimes(estimate, arguments), PosesWithTimes(truth, arguments)};
}

void PrintReport(const EvalArguments& arguments, const Evaluation& evaluation) {
  if (!arguments.json) {
    fmt::print("{}", ToText(evaluation));
    return;
  }
  nlohmann::ordered_json json = {{"estimate", arguments.estimate.string()},
                                 {"truth", arguments.truth.string()},
                                 {"align", arguments.alignment}};
  json.update(ToJson(evaluation));
  fmt::print("{}\n", json.dump(2));
}

void Eval(const EvalArguments& arguments) {
  const EvalInputs inputs = ReadEvalInputs(arguments);
  EvaluationOptions options;
  options.alignment = ParseAlignment(arguments.alignment);
  options.max_dt_ns = std::llround(1e9 * arguments.max_dt_s);
  const Evaluation evaluation = Evaluate(inputs.estimate, inputs.truth, options);
  PrintReport(arguments, evaluation);
  if (arguments.picture.empty()) return;
  const PoseSequence aligned = MovePoses(evaluation.truth_from_estimate, inputs.estimate);
  if (!DrawTrajectory({{aligned}, inputs.truth}, arguments.picture)) {
    spdlog::warn("no {}: gnuplot is missing or failed", arguments.picture.string());
  }
}

}  // namespace

void AddEvalCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("eval", "Measure a trajectory against the ground truth");
  const auto arguments = std::make_shared<EvalArguments>();
  command->add_option("EST", arguments->estimate, "estimated trajectory")->required();
  command->add_option("GT", arguments->truth, "ground truth")->required();
  command->add_option("--align", arguments->alignment, "what the estimate may be moved by")
      ->check(CLI::IsMember({"sim3", "se3", "scale", "none"}))
      ->capture_default_str();
  command->add_option("--max-dt", arguments->max_dt_s, "seconds between poses that are compared")
      ->check(CLI::Range(0.0, 1e6))
      ->capture_default_str();
  command->add_option("--times", arguments->times, "times of the rows of a KITTI file");
  command->add_flag("--json", arguments->json, "print JSON");
  command->add_option("--plot", arguments->picture, "draw both as PNG");
  command->footer(kFooter);
  command->callback([arguments] { Eval(*arguments); });
}

}  // namespace corvo
