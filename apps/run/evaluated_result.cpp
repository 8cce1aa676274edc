// SPDX-License-Identifier: MIT
#include "apps/run/evaluated_result.h"

#include <cmath>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "apps/dataset/ground_truth.h"
#include "apps/output/frame_tables.h"
#include "apps/run/result_folder.h"
#include "apps/run/run_plot.h"
#include "orb/error.h"
#include "vo/evaluation/time_offset.h"
#include "vo/io/decimal_time.h"

namespace corvo {
namespace {

namespace fs = std::filesystem;

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

/// Returns whether a path names a result of `corvo run` rather than ground truth.
bool IsResult(const fs::path& path) {
  return fs::is_regular_file(path / "trajectory.tum") && FindGroundTruth(path).empty();
}

/// Returns the files of every result that is evaluated.
std::vector<EvalFiles> ListFiles(const EvalArguments& arguments) {
  std::vector<fs::path> estimates = arguments.results;
  fs::path truth = arguments.truth;
  if (truth.empty() && estimates.size() == 2 && !IsResult(estimates.back())) {
    truth = estimates.back();
    estimates.pop_back();
  }
  if (estimates.size() > 1 && !arguments.frames.empty()) {
    throw Error("--frames: is possible with one result only");
  }
  if (estimates.size() > 1 && truth.empty() && !arguments.image.empty()) {
    throw Error("--plot: several results need one ground truth; give --gt GT");
  }
  std::vector<EvalFiles> files;
  for (const fs::path& estimate : estimates) files.push_back({estimate, truth, arguments.times});
  return files;
}

EvalInputs ReadInputs(const EvalArguments& arguments, const EvalFiles& files) {
  EvalInputs inputs = ReadEvalInputs(files);
  if (arguments.time_offset_s != 0 && !inputs.has_times) {
    throw Error("--time-offset: rows of KITTI files have no timestamps; give --times FILE");
  }
  const TimeNs offset_ns = Nanoseconds(arguments.time_offset_s);
  if (arguments.selection.SelectsAll()) {
    inputs.estimate = ShiftTimes(offset_ns, std::move(inputs.estimate));
    return inputs;
  }
  const fs::path frames = arguments.frames.empty()
                              ? inputs.estimate_file.parent_path() / "frames.csv"
                              : arguments.frames;
  if (arguments.frames.empty()) CheckResultFile(files.estimate, "frames.csv");
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

/// Replaces the names of the results by the paths of their files if two are equal.
void NameByPathIfEqual(std::vector<EvaluatedResult>& results) {
  std::set<std::string> names;
  for (const EvaluatedResult& result : results) names.insert(result.named.name);
  if (names.size() == results.size()) return;
  for (EvaluatedResult& result : results) result.named.name = result.inputs.estimate_file.string();
}

/// Returns the number of frames of the run in a result folder, or std::nullopt for anything else.
std::optional<int> CountFrames(const fs::path& result) {
  const fs::path table = result / "frames.csv";
  if (!fs::is_regular_file(table)) return std::nullopt;
  return static_cast<int>(ReadFrameTable(table).size());
}

EvaluatedResult EvaluateResult(const EvalArguments& arguments, const EvalFiles& files) {
  EvalInputs inputs = ReadInputs(arguments, files);
  const std::string offset_text = OffsetText(arguments, inputs);
  Evaluation evaluation = EvaluateInputs(arguments, inputs, offset_text);
  if (!offset_text.empty()) spdlog::warn("{}", offset_text);
  NamedEvaluation named{SequenceName(inputs.estimate_file),
                        static_cast<int>(inputs.estimate.size()), std::nullopt,
                        std::move(evaluation)};
  return {std::move(inputs), std::move(named)};
}

}  // namespace

std::vector<EvaluatedResult> EvaluateResults(const EvalArguments& arguments) {
  const std::vector<EvalFiles> files = ListFiles(arguments);
  if (files.size() == 1) return {EvaluateResult(arguments, files.front())};
  std::vector<EvaluatedResult> results;
  for (const EvalFiles& each : files) {
    try {
      results.push_back(EvaluateResult(arguments, each));
    } catch (const Error& error) {
      const std::string name = each.estimate.string();
      if (std::string_view(error.what()).starts_with(name)) throw;
      throw Error(fmt::format("{}: {}", name, error.what()));
    }
    results.back().named.num_frames = CountFrames(each.estimate);
  }
  NameByPathIfEqual(results);
  return results;
}

}  // namespace corvo
