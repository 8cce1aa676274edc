// SPDX-License-Identifier: MIT
#include "apps/commands/eval.h"

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "apps/commands/former_option.h"
#include "apps/dataset/frame_selection.h"
#include "apps/output/evaluation_report.h"
#include "apps/output/plot.h"
#include "apps/run/eval_inputs.h"

namespace corvo {
namespace {

constexpr const char* kFooter = R"(Examples:
  corvo eval result                                  # a run, and the truth that it found
  corvo eval result MH_01_easy                       # ... and the truth that a dataset ships
  corvo eval estimate.txt truth.txt
  corvo eval estimate.txt poses/03.txt --times sequences/03/times.txt
  corvo eval estimate.txt truth.txt --align se3 --max-dt 0.01 --plot error.png
  corvo eval result groundtruth.txt --states tracking --rpe-seconds 2 --json

EST and GT are in TUM format (8 columns: seconds, position, quaternion), KITTI format (12 columns,
no times) or EuRoC's (commas: ns, position, quaternion), whose truth is moved from the body to cam0
by the calibration beside it. Two KITTI files are compared row by row. --align sim3 is for monocular
trajectories. ATE and RPE are those of evo:
  evo_ape tum GT EST -as
  evo_rpe tum GT EST -as -d 1 -u f --all_pairs              # --rpe-frames 1
  evo_rpe tum GT EST -as -d 1 -u m --pairs_from_reference   # --rpe-meters 1)";

struct EvalArguments {
  EvalFiles files;
  std::filesystem::path image;
  std::filesystem::path frames;  ///< Empty: the frames.csv beside the estimate.
  FrameSelection selection;
  std::string alignment = "sim3";
  std::optional<double> max_dt_s;
  std::optional<double> rpe_meters;
  int rpe_frames = 1;
  double rpe_seconds = 1;
  bool json = false;
};

TimeNs Nanoseconds(double seconds) { return std::llround(1e9 * seconds); }

EvaluationOptions MakeOptions(const EvalArguments& arguments) {
  EvaluationOptions options;
  options.alignment = ParseAlignment(arguments.alignment);
  if (arguments.max_dt_s) options.max_dt_ns = Nanoseconds(*arguments.max_dt_s);
  options.relative_delta_frames = arguments.rpe_frames;
  options.relative_delta_ns = Nanoseconds(arguments.rpe_seconds);
  options.relative_delta_path = arguments.rpe_meters;
  return options;
}

EvalInputs ReadInputs(const EvalArguments& arguments) {
  EvalInputs inputs = ReadEvalInputs(arguments.files);
  if (arguments.selection.SelectsAll()) return inputs;
  const std::filesystem::path frames = arguments.frames.empty()
                                           ? inputs.estimate_file.parent_path() / "frames.csv"
                                           : arguments.frames;
  inputs.estimate = SelectFrames(inputs.estimate, frames, arguments.selection);
  return inputs;
}

void PrintReport(const EvalArguments& arguments, const EvalInputs& inputs,
                 const Evaluation& evaluation) {
  if (!arguments.json) {
    fmt::print("{}", ToText(evaluation));
    return;
  }
  nlohmann::ordered_json json = {{"estimate", inputs.estimate_file.string()},
                                 {"truth", inputs.truth_file.string()},
                                 {"align", arguments.alignment}};
  json.update(ToJson(evaluation));
  fmt::print("{}\n", json.dump(2));
}

void Eval(const EvalArguments& arguments) {
  const EvalInputs inputs = ReadInputs(arguments);
  const Evaluation evaluation = Evaluate(inputs.estimate, inputs.truth, MakeOptions(arguments));
  PrintReport(arguments, inputs, evaluation);
  if (arguments.image.empty()) return;
  const PoseSequence aligned = MovePoses(evaluation.truth_from_estimate, inputs.estimate);
  if (!DrawTrajectory({{aligned}, inputs.truth}, arguments.image)) {
    spdlog::warn("no {}: gnuplot is missing or failed", arguments.image.string());
  }
}

void AddInputOptions(CLI::App& command, EvalArguments& arguments) {
  command
      .add_option("EST", arguments.files.estimate,
                  "estimated trajectory, or the folder that corvo run wrote")
      ->required();
  command.add_option(
      "GT", arguments.files.truth,
      "ground truth, or the folder of a sequence that has it in its layout (default: "
      "what the run in EST was compared with)");
  command.add_option("--times", arguments.files.times, "times of the rows of a KITTI file");
  command
      .add_option("--states", arguments.selection.states,
                  "only frames that frames.csv has in these states, such as tracking")
      ->delimiter(',');
  command
      .add_option("--segment", arguments.selection.segment, "only frames of this segment, from 0")
      ->check(CLI::Range(0, 1'000'000'000));
  command.add_option("--frames", arguments.frames,
                     "the run's frames.csv (default: that beside the estimate)");
}

void AddMeasureOptions(CLI::App& command, EvalArguments& arguments) {
  command.add_option("--align", arguments.alignment, "what the estimate may be moved by")
      ->check(CLI::IsMember({"sim3", "se3", "scale", "none"}))
      ->capture_default_str();
  command
      .add_option("--max-dt", arguments.max_dt_s,
                  "seconds between poses that are compared (default: half a frame)")
      ->check(CLI::Range(0.0, 1e6));
  command.add_option("--rpe-frames", arguments.rpe_frames, "frames that a relative error spans")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  command.add_option("--rpe-seconds", arguments.rpe_seconds, "seconds that another spans")
      ->check(CLI::Range(1e-9, 1e6))
      ->capture_default_str();
  command
      .add_option("--rpe-meters", arguments.rpe_meters,
                  "length of the true path that a third spans, in the truth's unit (default: none)")
      ->check(CLI::Range(1e-9, 1e9));
  AddFormerOption(command, "--rpe-metres", "is now --rpe-meters");
}

}  // namespace

void AddEvalCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("eval", "Measure a trajectory against the ground truth");
  const auto arguments = std::make_shared<EvalArguments>();
  AddInputOptions(*command, *arguments);
  AddMeasureOptions(*command, *arguments);
  command->add_flag("--json", arguments->json, "print JSON");
  command->add_option("--plot", arguments->image, "draw both as PNG");
  command->footer(kFooter);
  command->callback([arguments] { Eval(*arguments); });
}

}  // namespace corvo
