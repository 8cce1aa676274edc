// SPDX-License-Identifier: MIT
#include "apps/commands/run.h"

#include <filesystem>
#include <memory>
#include <string>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "apps/commands/force_flag.h"
#include "apps/commands/former_option.h"
#include "apps/output/error_text.h"
#include "apps/output/output_folder.h"
#include "apps/output/plot_file.h"
#include "apps/output/printable.h"
#include "apps/output/track_drawings.h"
#include "apps/run/checkpoint.h"
#include "apps/run/image_processing.h"
#include "apps/run/known_length_arguments.h"
#include "apps/run/number_option.h"
#include "apps/run/run_inputs.h"
#include "apps/run/run_plot.h"
#include "apps/run/run_record.h"
#include "apps/run/run_results.h"
#include "apps/run/run_summary.h"
#include "apps/system/interruption.h"
#include "orb/error.h"
#include "vo/io/file_bytes.h"

namespace corvo {
namespace {

constexpr const char* kRunFooter = R"(Examples:
  corvo run sequences/03 -o result                    # KITTI with the dataset's calibration
  corvo run sequences/03 --gt poses/03.txt -o result  # ... evaluated against ground truth
  corvo run MH_01_easy/mav0 -o result                 # EuRoC
  corvo run images/ --camera camera.yaml --fps 30 -o result
  corvo run 'images/left*.png' --camera camera.yaml --every 2 --resize 0.5 -o result
  corvo run drive.mp4 --camera phone.yaml --mask bonnet.png -o result
  corvo run images/ --focal auto -o result            # without a calibration
  corvo run images/ --fov 70 -o result                # ... with the lens's field of view
  corvo run sequences/03 --refine -o result           # with global refinement at the end
  corvo run sequences/03 --draw film.mp4 -o result    # with a film of the tracked features
  corvo run sequences/03 --plot figure.pdf -o result  # with a vector graphic for a paper
  corvo run sequences/03 --camera-height 1.65 -o result  # in meters
  corvo run drive.mp4 --camera phone.yaml --realtime -o result  # ... as fast as it was taken
  corvo run camera:0 --camera webcam.yaml --count 1000 -o result

Exit codes: 0 done, 1 invalid usage, configuration or input, 2 never initialized, 3 lost part-way,
130 interrupted with Ctrl-C, 143 with SIGTERM, 129 with SIGHUP. However a run ends, what it has found
is written and marked as incomplete; a complete earlier result is kept. With a live camera, Ctrl-C
ends the sequence and the result is complete.)";

std::string FramesText(const RunSummary& summary) {
  return summary.num_expected
             ? fmt::format("{} of {} frames", summary.num_frames, *summary.num_expected)
             : fmt::format("{} frames", summary.num_frames);
}

/// Saves at least a checkpoint of a run whose results cannot be written in full, as on a full disk.
[[noreturn]] void SaveTheTrajectory(const std::string& error, const RunRecord& record,
                                    const Checkpoint& checkpoint, const OutputFolder& output) {
  output.Discard();
  try {
    checkpoint.Save(record.odometry, error);
  } catch (const std::exception&) {  // The first error says why.
    throw Error(error);
  }
  throw Error(fmt::format("{}; only the trajectory is in {}", error, output.checkpoint().string()));
}

/// Throws corvo::Error if --plot names a file of the results.
void CheckPlot(const RunArguments& arguments) {
  const std::filesystem::path result = arguments.output / "trajectory.png";
  if (arguments.plot.empty() || std::filesystem::weakly_canonical(arguments.plot) !=
                                    std::filesystem::weakly_canonical(result)) {
    return;
  }
  throw Error(fmt::format("--plot: {} is a file of the results; choose another name",
                          arguments.plot.string()));
}

/// Prints what the run has found, and returns its exit code. `folder` has the results.
int Report(const RunArguments& arguments, const RunRecord& record, const RunSummary& summary,
           const std::filesystem::path& folder) {
  if (arguments.json) {
    fmt::print("{}", ReadFileBytes(folder / "summary.json", kMaxTextBytes));
  } else if (summary.end.is_complete() && spdlog::should_log(spdlog::level::info)) {
    fmt::print("{}", Printable(SummaryText(arguments, summary)));
    if (record.realtime) fmt::print("{}", ToText(*record.realtime));
  }
  if (summary.end.is_complete()) return static_cast<int>(summary.outcome);
  spdlog::error("{}, after {}; the partial result is in {}", summary.end.why, FramesText(summary),
                folder.string());
  return summary.end.exit_code;
}

/// Throws corvo::Error if a known length is malformed.
void CheckKnownLengths(const RunArguments& arguments) {
  for (const std::string& text : arguments.known_distances) ParseKnownDistance(text);
  for (const std::string& text : arguments.known_sizes) ParseKnownSize(text);
}

int Run(const RunArguments& arguments, const Interruption& interruption) {
  CheckPlot(arguments);
  CheckKnownLengths(arguments);
  OutputFolder output(arguments.output, PlanOfRun(arguments.force));
  PlotFile plot(arguments.plot, arguments.force);
  TrackDrawings drawings(arguments.drawings, arguments.force);
  RunInputs inputs = ReadInputs(arguments, interruption);
  Checkpoint checkpoint(arguments, inputs, output);
  const RunRecord record = ProcessSequence(arguments, interruption, inputs, drawings, checkpoint);
  const RunSummary summary = Summarize(arguments, inputs, record);
  try {
    StageResults(arguments, inputs, record, summary, output);
  } catch (const std::exception& error) {
    SaveTheTrajectory(ErrorText(error), record, checkpoint, output);
  }
  const std::filesystem::path folder = CommitResults(record.end, arguments.output, output);
  plot.Draw(MakeRunPlot(arguments, inputs, record, summary), record.end.is_complete());
  drawings.Finish(record.end.is_complete());
  return Report(arguments, record, summary, folder);
}

int RunUnlessInterrupted(const RunArguments& arguments) {
  IgnoreClosedPipes();  // A reader of the messages that goes away does not end the run.
  const Interruption interruption;
  try {
    return Run(arguments, interruption);
  } catch (const Interrupted&) {
    spdlog::error("interrupted during the calibration of the camera; nothing was written");
    return ExitCodeOf(interruption.PendingSignal());
  }
}

void AddOutputOptions(CLI::App& command, RunArguments& arguments) {
  command.add_option("-o,--output", arguments.output, "folder for the results")->required();
  AddForceFlag(command, arguments.force);
  command.add_option("--draw", arguments.drawings,
                     "drawings of every frame with its tracked features: a folder for images, or a "
                     "film (.mp4, .mov, .mkv, .avi)");
  command.add_option("--plot", arguments.plot,
                     "file for a plot of the trajectory like trajectory.png, as .pdf, .svg or "
                     ".png");
  command.add_flag("--keyframe-features", arguments.keyframe_features,
                   "write the pixels and descriptors of the keyframes, for place recognition");
  command.add_flag("--json", arguments.json, "print summary.json instead of a text");
}

void AddScaleOptions(CLI::App& command, RunArguments& arguments) {
  CLI::Option* meters_per_unit =
      command
          .add_option("--meters-per-unit", arguments.meters_per_unit,
                      "scale factor of the written trajectories and map (default: 1)")
          ->check(NumberRange(1e-12, 1e12));
  CLI::Option* camera_height =
      command
          .add_option("--camera-height", arguments.camera_height_m,
                      "height of the camera above the ground that it moves over, m: lengths are in "
                      "meters, and the scale is held along the path")
          ->check(NumberRange(1e-3, 1e6))
          ->excludes(meters_per_unit);
  CLI::Option* known_distance =
      command
          .add_option("--known-distance", arguments.known_distances,
                      "FRAME,FRAME,METERS: distance between the positions of the camera at two "
                      "frames; lengths of their segment are in meters. Several hold the scale "
                      "between them")
          ->allow_extra_args(false)
          ->excludes(meters_per_unit)
          ->excludes(camera_height);
  command
      .add_option("--known-size", arguments.known_sizes,
                  "FRAME,X,Y,X,Y,FRAME,X,Y,X,Y,METERS: size of an object, with the pixels of its "
                  "two ends in two or more frames; otherwise like --known-distance")
      ->allow_extra_args(false)
      ->excludes(meters_per_unit)
      ->excludes(camera_height)
      ->excludes(known_distance);
  AddFormerOption(command, "--metres-per-unit", "is now --meters-per-unit");
}

void AddTruthOptions(CLI::App& command, RunArguments& arguments) {
  command.add_option("--gt", arguments.truth,
                     "ground truth in TUM, KITTI or EuRoC format, or 'none' (default: the ground "
                     "truth in the dataset's layout, if any)");
  command
      .add_option("--max-dt", arguments.max_dt_s,
                  "maximum time difference of compared poses, s (default: half a frame interval)")
      ->check(NumberRange(0.0, 1e6));
}

}  // namespace

void AddRunCommand(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("run", "Run visual odometry on an image sequence");
  const auto arguments = std::make_shared<RunArguments>();
  AddInputOptions(*command, *arguments);
  AddOutputOptions(*command, *arguments);
  AddScaleOptions(*command, *arguments);
  AddTruthOptions(*command, *arguments);
  command->add_option("--config", arguments->config, "options file; see 'corvo config'");
  command->add_flag("--refine", arguments->refine,
                    "adjust the whole sequence after the last image and write the refined "
                    "trajectory");
  command
      ->add_option(
          "--calibration", arguments->calibration,
          "estimate: estimate the camera, with its standard deviations as prior; fixed: use the "
          "camera exactly as given (default: as set by calibration.enabled in --config)")
      ->check(CLI::IsMember({"estimate", "fixed"}));
  command->add_flag("--realtime", arguments->realtime,
                    "take each image when a camera would deliver it, drop those that come while an "
                    "older one is processed, and print the latencies; always so with a connected "
                    "camera");
  command
      ->add_option("--threads", arguments->threads, "number of threads; does not affect the result")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->footer(kRunFooter);
  command->callback([arguments, &exit_code] { exit_code = RunUnlessInterrupted(*arguments); });
}

}  // namespace corvo
