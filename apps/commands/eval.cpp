// SPDX-License-Identifier: MIT
#include "apps/commands/eval.h"

#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "apps/commands/force_flag.h"
#include "apps/commands/former_option.h"
#include "apps/dataset/frame_selection.h"
#include "apps/output/evaluation_report.h"
#include "apps/output/json_text.h"
#include "apps/output/plot_file.h"
#include "apps/run/eval_inputs.h"
#include "apps/run/number_option.h"
#include "apps/run/result_folder.h"
#include "apps/run/run_plot.h"
#include "orb/error.h"
#include "vo/evaluation/time_offset.h"
#include "vo/io/decimal_time.h"

namespace corvo {
namespace {

constexpr const char* kFooter = R"(Examples:
  corvo eval result                                  # a run and the ground truth that it used
  corvo eval result MH_01_easy                       # a run and the ground truth of a dataset
  corvo eval estimate.txt truth.txt
  corvo eval estimate.txt poses/03.txt --times sequences/03/times.txt
  corvo eval estimate.txt truth.txt --align se3 --max-dt 0.01 --plot error.png
  corvo eval estimate.txt truth.txt --time-offset -0.052   # a clock that is ahead by 52 ms
  corvo eval result groundtruth.txt --states tracking --rpe-seconds 2 --json

EST and GT are in TUM format (8 columns: seconds, position, quaternion), KITTI format (12 columns,
no timestamps) or EuRoC format (comma-separated: ns, position, quaternion). EuRoC ground truth is
moved from the body to cam0 with the calibration beside it. Two KITTI files are compared row by row.
Use --align sim3 for monocular trajectories. ATE and RPE are defined as in evo:
  evo_ape tum GT EST -as
  evo_rpe tum GT EST -as -d 1 -u f --all_pairs              # --rpe-frames 1
  evo_rpe tum GT EST -as -d 1 -u m --pairs_from_reference   # --rpe-meters 1)";

struct EvalArguments {
  EvalFiles files;
  std::filesystem::path image;
  std::filesystem::path frames;  ///< If empty, the frames.csv beside the estimate.
  FrameSelection selection;
  std::string alignment = "sim3";
  std::optional<double> max_dt_s;
  std::optional<double> rpe_meters;
  int rpe_frames = 1;
  double rpe_seconds = 1;
  double time_offset_s = 0;
  bool json = false;
  bool force = false;
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
  if (arguments.time_offset_s != 0 && !inputs.has_times) {
    throw Error("--time-offset: rows of KITTI files have no timestamps; give --times FILE");
  }
  const TimeNs offset_ns = Nanoseconds(arguments.time_offset_s);
  if (arguments.selection.SelectsAll()) {
    inputs.estimate = ShiftTimes(offset_ns, std::move(inputs.estimate));
    return inputs;
  }
  const std::filesystem::path frames = arguments.frames.empty()
                                           ? inputs.estimate_file.parent_path() / "frames.csv"
                                           : arguments.frames;
  if (arguments.frames.empty()) CheckResultFile(arguments.files.estimate, "frames.csv");
  inputs.estimate =
      ShiftTimes(offset_ns, SelectFrames(inputs.estimate, frames, arguments.selection));
  return inputs;
}

/// Returns a text on the offset that the estimate's times seem to have, and how to correct it;
/// empty if no offset is suspected.
std::string OffsetText(const EvalArguments& arguments, const EvalInputs& inputs) {
  if (!inputs.has_times) return "";
  const std::optional<TimeOffset> offset = FindTimeOffset(inputs.estimate, inputs.truth);
  if (!offset) return "";
  const double offset_s = arguments.time_offset_s + ToSeconds(offset->offset_ns);
  std::string text = fmt::format(
      "the timestamps of the estimate and the ground truth seem to differ by an offset: with "
      "--time-offset {:.4f} the ATE is {:.6g}",
      offset_s, offset->rmse);
  if (offset->rmse_without) text += fmt::format(" instead of {:.6g}", *offset->rmse_without);
  return text;
}

/// Evaluates the estimate. An error states where the times of both start, and `offset_text`.
Evaluation EvaluateInputs(const EvalArguments& arguments, const EvalInputs& inputs,
                          const std::string& offset_text) {
  try {
    return Evaluate(inputs.estimate, inputs.truth, MakeOptions(arguments));
  } catch (const Error& error) {
    if (!inputs.has_times || inputs.estimate.empty() || inputs.truth.empty()) throw;
    throw Error(fmt::format("{}; the estimate starts at {} s, the ground truth at {} s{}{}",
                            error.what(), FormatSeconds(inputs.estimate.front().time_ns),
                            FormatSeconds(inputs.truth.front().time_ns),
                            offset_text.empty() ? "" : "; ", offset_text));
  }
}

void PrintReport(const EvalArguments& arguments, const EvalInputs& inputs,
                 const Evaluation& evaluation) {
  if (!arguments.json) {
    fmt::print("{}", ToText(evaluation));
    return;
  }
  nlohmann::ordered_json json = {{"estimate", inputs.estimate_file.string()},
                                 {"truth", inputs.truth_file.string()},
                                 {"align", arguments.alignment},
                                 {"time_offset_s", arguments.time_offset_s}};
  json.update(ToJson(evaluation));
  fmt::print("{}", JsonText(json));
}

TrajectoryPlot MakePlot(const EvalInputs& inputs, const Evaluation& evaluation) {
  TrajectoryPlot plot;
  plot.title = fmt::format("{}: {} poses, {}", SequenceName(inputs.estimate_file),
                           inputs.estimate.size(), AteText(evaluation));
  plot.estimates.push_back({"estimate", MovePoses(evaluation.truth_from_estimate, inputs.estimate),
                            evaluation.aligned_pairs});
  plot.truth = inputs.truth;
  plot.unit = std::string("m");
  plot.has_times = inputs.has_times;
  plot.ate_rmse = evaluation.absolute.rmse;
  return plot;
}

void Eval(const EvalArguments& arguments) {
  PlotFile plot(arguments.image, arguments.force);
  const EvalInputs inputs = ReadInputs(arguments);
  const std::string offset_text = OffsetText(arguments, inputs);
  const Evaluation evaluation = EvaluateInputs(arguments, inputs, offset_text);
  if (!offset_text.empty()) spdlog::warn("{}", offset_text);
  PrintReport(arguments, inputs, evaluation);
  plot.Draw(MakePlot(inputs, evaluation));
}

void AddInputOptions(CLI::App& command, EvalArguments& arguments) {
  command
      .add_option("EST", arguments.files.estimate,
                  "estimated trajectory, or output folder of 'corvo run'")
      ->required();
  command.add_option(
      "GT", arguments.files.truth,
      "ground truth, or folder of a dataset sequence that has it (default: the ground truth that "
      "the run in EST was compared with)");
  command.add_option("--times", arguments.files.times,
                     "file with the timestamps of the rows of a KITTI file");
  command
      .add_option("--states", arguments.selection.states,
                  "use only frames whose state in frames.csv is one of these, e.g. tracking")
      ->delimiter(',');
  command
      .add_option("--segment", arguments.selection.segment,
                  "use only frames of this segment, from 0")
      ->check(CLI::Range(0, 1'000'000'000));
  command.add_option("--frames", arguments.frames,
                     "frames.csv of the run (default: the one beside the estimate)");
}

void AddMeasureOptions(CLI::App& command, EvalArguments& arguments) {
  command.add_option("--align", arguments.alignment, "transformation that aligns the estimate")
      ->check(CLI::IsMember({"sim3", "se3", "scale", "none"}))
      ->capture_default_str();
  command
      .add_option("--max-dt", arguments.max_dt_s,
                  "maximum time difference of compared poses, s (default: half a frame interval)")
      ->check(NumberRange(0.0, 1e6));
  command
      .add_option("--time-offset", arguments.time_offset_s,
                  "seconds that are added to the timestamps of the estimate")
      ->check(NumberRange(-4e9, 4e9))
      ->capture_default_str();
  command.add_option("--rpe-frames", arguments.rpe_frames, "interval of the RPE over frames")
      ->check(CLI::Range(1, 1'000'000))
      ->capture_default_str();
  command.add_option("--rpe-seconds", arguments.rpe_seconds, "interval of the RPE over time, s")
      ->check(NumberRange(1e-9, 1e6))
      ->capture_default_str();
  command
      .add_option("--rpe-meters", arguments.rpe_meters,
                  "interval of the RPE over the ground truth's path, in its unit (default: none)")
      ->check(NumberRange(1e-9, 1e9));
  AddFormerOption(command, "--rpe-metres", "is now --rpe-meters");
}

}  // namespace

void AddEvalCommand(CLI::App& app) {
  CLI::App* command = app.add_subcommand("eval", "Evaluate a trajectory against ground truth");
  const auto arguments = std::make_shared<EvalArguments>();
  AddInputOptions(*command, *arguments);
  AddMeasureOptions(*command, *arguments);
  command->add_flag("--json", arguments->json, "print JSON");
  command->add_option("--plot", arguments->image,
                      "file for a plot of both trajectories and the errors, as .pdf, .svg or .png");
  AddForceFlag(*command, arguments->force);
  command->footer(kFooter);
  command->callback([arguments] { Eval(*arguments); });
}

}  // namespace corvo
