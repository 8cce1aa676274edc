// SPDX-License-Identifier: MIT
#include "apps/commands/eval.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "apps/commands/force_flag.h"
#include "apps/commands/former_option.h"
#include "apps/output/evaluation_report.h"
#include "apps/output/evaluation_table.h"
#include "apps/output/json_text.h"
#include "apps/output/output_folder.h"
#include "apps/output/plot_file.h"
#include "apps/run/evaluated_result.h"
#include "apps/run/number_option.h"
#include "apps/run/run_plot.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

constexpr const char* kEvalFooter = R"(Examples:
  corvo eval result                                  # a run and the ground truth that it used
  corvo eval result MH_01_easy                       # a run and the ground truth of a dataset
  corvo eval estimate.txt truth.txt
  corvo eval estimate.txt poses/03.txt --times sequences/03/times.txt
  corvo eval estimate.txt truth.txt --align se3 --max-dt 0.01 --plot error.pdf
  corvo eval result estimate.txt --gt truth.txt      # a table with one row for each result
  corvo eval result --per-pose errors.csv            # the errors of every pose
  corvo eval estimate.txt truth.txt --time-offset -0.052   # a clock that is ahead by 52 ms
  corvo eval result groundtruth.txt --states tracking --rpe-seconds 2 --json

Without --gt, a last argument after a single EST is GT unless it is a result folder; several results
are compared with --gt, or each with the ground truth of its run. The table has root mean squares.
EST and GT are in TUM format (8 columns: seconds, position, quaternion), KITTI format (12 columns,
no timestamps) or EuRoC format (comma-separated: ns, position, quaternion). EuRoC ground truth is
moved from the body to cam0 with the calibration beside it. Two KITTI files are compared row by row.
Use --align sim3 for monocular trajectories. ATE and RPE are defined as in evo:
  evo_ape tum GT EST -as
  evo_rpe tum GT EST -as -d 1 -u f --all_pairs              # --rpe-frames 1
  evo_rpe tum GT EST -as -d 1 -u m --pairs_from_reference   # --rpe-meters 1)";

std::vector<NamedEvaluation> NamesOf(const std::vector<EvaluatedResult>& results) {
  std::vector<NamedEvaluation> named;
  for (const EvaluatedResult& result : results) named.push_back(result.named);
  return named;
}

nlohmann::ordered_json ToJson(const EvalArguments& arguments, const EvaluatedResult& result) {
  nlohmann::ordered_json json = {{"estimate", result.inputs.estimate_file.string()},
                                 {"truth", result.inputs.truth_file.string()},
                                 {"align", arguments.alignment},
                                 {"time_offset_s", arguments.time_offset_s}};
  json.update(ToJson(result.named.evaluation));
  return json;
}

/// Prints the measures of one result, or a table of several.
void PrintReport(const EvalArguments& arguments, const std::vector<EvaluatedResult>& results) {
  if (arguments.json) {
    nlohmann::ordered_json json = nlohmann::ordered_json::array();
    for (const EvaluatedResult& result : results) json.push_back(ToJson(arguments, result));
    fmt::print("{}", JsonText(results.size() == 1 ? json.front() : json));
  } else if (results.size() == 1) {
    fmt::print("{}", ToText(results.front().named.evaluation));
  } else {
    fmt::print("{}", EvaluationTable(NamesOf(results)));
  }
}

/// Returns the plot of results that have the same ground truth.
TrajectoryPlot MakePlot(const std::vector<EvaluatedResult>& results) {
  const EvaluatedResult& first = results.front();
  TrajectoryPlot plot;
  plot.truth = first.inputs.truth;
  plot.unit = std::string("m");
  plot.has_times = first.inputs.has_times;
  for (const EvaluatedResult& result : results) {
    const Evaluation& evaluation = result.named.evaluation;
    plot.estimates.push_back({fmt::format("{}, {}", result.named.name, AteText(evaluation)),
                              MovePoses(evaluation.truth_from_estimate, result.inputs.estimate),
                              evaluation.aligned_pairs});
  }
  if (results.size() > 1) {
    plot.title = fmt::format("{} results compared with {}", results.size(),
                             SequenceName(first.inputs.truth_file));
    return plot;
  }
  plot.title = fmt::format("{}: {} poses, {}", first.named.name, first.inputs.estimate.size(),
                           AteText(first.named.evaluation));
  plot.estimates.front().name = "estimate";
  plot.ate_rmse = first.named.evaluation.absolute.rmse;
  return plot;
}

/// Prepares the file of --per-pose, if it was given.
void OpenPoseErrors(const EvalArguments& arguments, std::optional<OutputFolder>& output) {
  const fs::path& file = arguments.pose_errors;
  if (file.empty()) return;
  output.emplace(fs::absolute(file).parent_path(), PlanOfFile(file, {}, arguments.force));
}

void Eval(const EvalArguments& arguments) {
  PlotFile plot(arguments.image, arguments.force);
  std::optional<OutputFolder> pose_errors;
  OpenPoseErrors(arguments, pose_errors);
  const std::vector<EvaluatedResult> results = EvaluateResults(arguments);
  PrintReport(arguments, results);
  if (pose_errors) {
    pose_errors->Write(arguments.pose_errors.filename().string(), PoseErrorTable(NamesOf(results)));
    pose_errors->Commit();
  }
  plot.Draw(MakePlot(results));
}

void AddInputOptions(CLI::App& command, EvalArguments& arguments) {
  command
      .add_option(
          "EST", arguments.results,
          "estimated trajectories, or output folders of 'corvo run'; after a single one, GT "
          "may follow")
      ->type_name("")
      ->required();
  command.add_option(
      "--gt", arguments.truth,
      "ground truth, or folder of a dataset sequence that has it (default: the ground truth that "
      "the run in EST was compared with)");
  command.add_option("--times", arguments.times,
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
  command->add_option("--per-pose", arguments->pose_errors,
                      "CSV file for the errors of every pose: timestamp, translation error in "
                      "meters, rotation error in degrees");
  command->add_flag("--json", arguments->json, "print JSON");
  command->add_option("--plot", arguments->image,
                      "file for a plot of both trajectories and the errors, as .pdf, .svg or .png");
  AddForceFlag(*command, arguments->force);
  command->footer(kEvalFooter);
  command->callback([arguments] { Eval(*arguments); });
}

}  // namespace corvo
