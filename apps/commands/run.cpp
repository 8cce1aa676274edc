// SPDX-License-Identifier: MIT
#include "apps/commands/run.h"

#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include "apps/commands/former_option.h"
#include "apps/output/output_folder.h"
#include "apps/output/track_drawings.h"
#include "apps/run/interruption.h"
#include "apps/run/progress.h"
#include "apps/run/progress_line.h"
#include "apps/run/run_inputs.h"
#include "apps/run/run_record.h"
#include "apps/run/run_results.h"
#include "apps/run/stopwatch.h"

namespace corvo {
namespace {

constexpr const char* kFooter = R"(Examples:
  corvo run sequences/03 -o result                    # KITTI with the dataset's calibration
  corvo run sequences/03 --gt poses/03.txt -o result  # ... evaluated against ground truth
  corvo run MH_01_easy/mav0 -o result                 # EuRoC
  corvo run images/ --camera camera.yaml --fps 30 -o result
  corvo run 'images/left*.png' --camera camera.yaml --every 2 --resize 0.5 -o result
  corvo run drive.mp4 --camera phone.yaml --mask bonnet.png -o result
  corvo run images/ --focal auto -o result            # without a calibration
  corvo run images/ --fov 70 -o result                # ... with the lens's field of view
  corvo run sequences/03 --refine -o result           # with global refinement at the end
  corvo run camera:0 --camera webcam.yaml --count 1000 -o result

Exit codes: 0 done, 1 invalid usage, configuration or input, 2 never initialized, 3 lost part-way,
130 interrupted with Ctrl-C, in which case nothing is written and earlier results are kept. With a
live camera, Ctrl-C ends the sequence and the results are written.)";

/// Returns an empty record whose odometry reports to it.
RunRecord MakeRecord(const RunInputs& inputs, const RunArguments& arguments) {
  RunRecord record(Odometry(inputs.camera, inputs.options, arguments.threads));
  record.odometry.SetLandmarkCallback(
      [finished = record.finished.get()](const MarginalizedLandmark& landmark) {
        finished->Add(landmark);
      });
  if (arguments.refine) record.odometry.SetObservationCallback(record.observations.Callback());
  return record;
}

/// Refines the recorded sequence as a whole and shows the progress.
void RefineRecord(const std::function<bool()>& is_interrupted, RunRecord& record) {
  ProgressLine line;
  record.refinement = Refine(record.odometry, record.observations, {}, [&](double share) {
    line.Show(share, "refining");
    return !is_interrupted();
  });
  record.trajectory = record.refinement->trajectory;
  record.is_interrupted = is_interrupted();
}

RunRecord ProcessImages(RunInputs& inputs, const RunArguments& arguments,
                        const Interruption& interruption) {
  RunRecord record = MakeRecord(inputs, arguments);
  ProgressReport progress(inputs.source.size().value_or(0));
  TrackDrawings drawings(arguments.drawings);
  Stopwatch watch;
  const auto is_interrupted = [&] {
    return interruption.IsRequested() && !inputs.source.is_live();
  };
  while (const std::optional<TimedImage> next = inputs.source.Next()) {
    FrameTiming timing;
    timing.read_ms = watch.LapMs();
    const FrameResult frame = record.odometry.Process(next->image, next->time_ns, next->mask);
    timing.total_ms = watch.LapMs();
    timing.stages = record.odometry.last_times();
    record.timings.push_back(timing);
    drawings.Add(next->image, record.odometry.last_mask(), record.odometry.last_frame(), frame);
    progress.Add(frame);
    watch.LapMs();
    if (!interruption.IsRequested()) continue;
    record.is_interrupted = is_interrupted();
    break;
  }
  record.trajectory = record.odometry.Finish();
  if (arguments.refine && !record.is_interrupted) RefineRecord(is_interrupted, record);
  record.trajectory = Scale(arguments.meters_per_unit.value_or(1), std::move(record.trajectory));
  record.elapsed_s = watch.ElapsedMs() / 1e3;
  return record;
}

int Run(const RunArguments& arguments, const Interruption& interruption) {
  RunInputs inputs = ReadInputs(arguments, interruption);
  OutputFolder output(arguments.output);
  const RunRecord record = ProcessImages(inputs, arguments, interruption);
  if (record.is_interrupted) {
    spdlog::error("interrupted after {} frames; nothing was written", record.timings.size());
    return kInterrupted;
  }
  const RunSummary summary = Summarize(arguments, inputs, record);
  WriteResults(arguments, inputs, record, summary, output);
  fmt::print("{}", SummaryText(arguments, summary));
  return static_cast<int>(summary.outcome);
}

int RunUnlessInterrupted(const RunArguments& arguments) {
  const Interruption interruption;  // Before any thread starts: threads inherit the signal mask.
  try {
    return Run(arguments, interruption);
  } catch (const Interrupted&) {
    spdlog::error("interrupted during the calibration of the camera; nothing was written");
    return kInterrupted;
  }
}

void AddOutputOptions(CLI::App& command, RunArguments& arguments) {
  command.add_option("-o,--output", arguments.output, "folder for the results")->required();
  command.add_option("--draw", arguments.drawings,
                     "folder for drawings of every frame with its tracked features");
  command
      .add_option("--meters-per-unit", arguments.meters_per_unit,
                  "scale factor of the written trajectories and map (default: 1)")
      ->check(CLI::Range(1e-12, 1e12));
  AddFormerOption(command, "--metres-per-unit", "is now --meters-per-unit");
}

void AddTruthOptions(CLI::App& command, RunArguments& arguments) {
  command.add_option("--gt", arguments.truth,
                     "ground truth in TUM, KITTI or EuRoC format, or 'none' (default: the ground "
                     "truth in the dataset's layout, if any)");
  command
      .add_option("--max-dt", arguments.max_dt_s,
                  "maximum time difference of compared poses, s (default: half a frame interval)")
      ->check(CLI::Range(0.0, 1e6));
}

}  // namespace

void AddRunCommand(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("run", "Run visual odometry on an image sequence");
  const auto arguments = std::make_shared<RunArguments>();
  AddInputOptions(*command, *arguments);
  AddOutputOptions(*command, *arguments);
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
  command
      ->add_option("--threads", arguments->threads, "number of threads; does not affect the result")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->footer(kFooter);
  command->callback([arguments, &exit_code] { exit_code = RunUnlessInterrupted(*arguments); });
}

}  // namespace corvo
