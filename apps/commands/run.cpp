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
  corvo run sequences/03 -o result                    # KITTI odometry, its own calibration
  corvo run sequences/03 --gt poses/03.txt -o result  # ... and how far off it is
  corvo run MH_01_easy/mav0 -o result                 # EuRoC
  corvo run images/ --camera camera.yaml --fps 30 -o result
  corvo run 'images/left*.png' --camera camera.yaml --every 2 --resize 0.5 -o result
  corvo run drive.mp4 --camera phone.yaml --mask bonnet.png -o result
  corvo run images/ --focal auto -o result            # ... no calibration at hand
  corvo run sequences/03 --refine -o result           # ... adjusted as a whole at the end
  corvo run camera:0 --camera webcam.yaml --count 1000 -o result

Exit codes: 0 done, 1 wrong usage, configuration or input, 2 never initialized, 3 lost part-way,
130 interrupted with Ctrl-C: nothing is written, and earlier results stay as they are. A camera's
sequence is ended by Ctrl-C, and written.)";

/// What is recorded, before the first image.
RunRecord MakeRecord(const RunInputs& inputs, const RunArguments& arguments) {
  RunRecord record(Odometry(inputs.camera, inputs.options, arguments.threads));
  record.odometry.SetLandmarkCallback(
      [finished = record.finished.get()](const MarginalizedLandmark& landmark) {
        finished->Add(landmark);
      });
  if (arguments.refine) record.odometry.SetObservationCallback(record.observations.Callback());
  return record;
}

/// Adjusts what was recorded as a whole, and shows how far that is.
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
    drawings.Add(next->image, record.odometry.last_frame(), frame);
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
    spdlog::error("interrupted after {} frames: nothing is written", record.timings.size());
    return kInterrupted;
  }
  const RunSummary summary = Summarize(arguments, inputs, record);
  WriteResults(arguments, inputs, record, summary, output);
  fmt::print("{}", SummaryText(arguments, summary));
  return static_cast<int>(summary.outcome);
}

int RunUnlessInterrupted(const RunArguments& arguments) {
  const Interruption interruption;  // Before any thread begins: each takes it over.
  try {
    return Run(arguments, interruption);
  } catch (const Interrupted&) {
    spdlog::error("interrupted while the camera was looked for: nothing is written");
    return kInterrupted;
  }
}

void AddOutputOptions(CLI::App& command, RunArguments& arguments) {
  command.add_option("-o,--output", arguments.output, "folder for the results")->required();
  command.add_option("--draw", arguments.drawings,
                     "folder for a drawing of every frame with its tracked features");
  command
      .add_option("--meters-per-unit", arguments.meters_per_unit,
                  "scale of the written trajectories and map (default: the run's own unit)")
      ->check(CLI::Range(1e-12, 1e12));
  AddFormerOption(command, "--metres-per-unit", "is now --meters-per-unit");
}

void AddTruthOptions(CLI::App& command, RunArguments& arguments) {
  command.add_option("--gt", arguments.truth,
                     "ground truth in TUM, KITTI or EuRoC format (default: that of the dataset's "
                     "layout, if it is there), or 'none'");
  command
      .add_option("--max-dt", arguments.max_dt_s,
                  "seconds between poses that are compared (default: half a frame)")
      ->check(CLI::Range(0.0, 1e6));
}

}  // namespace

void AddRunCommand(CLI::App& app, int& exit_code) {
  CLI::App* command = app.add_subcommand("run", "Run visual odometry on an image sequence");
  const auto arguments = std::make_shared<RunArguments>();
  AddInputOptions(*command, *arguments);
  AddOutputOptions(*command, *arguments);
  AddTruthOptions(*command, *arguments);
  command->add_option("--config", arguments->config, "options; see 'corvo config'");
  command->add_flag("--refine", arguments->refine,
                    "after the last image adjust the whole sequence, and write the trajectory that "
                    "comes of it");
  command
      ->add_option(
          "--calibration", arguments->calibration,
          "estimate: the camera is known to within its standard deviations, and estimated; fixed: "
          "it is exactly as given (default: as calibration.enabled of --config says)")
      ->check(CLI::IsMember({"estimate", "fixed"}));
  command->add_option("--threads", arguments->threads, "threads; never changes the result")
      ->check(CLI::Range(1, 256))
      ->capture_default_str();
  command->footer(kFooter);
  command->callback([arguments, &exit_code] { exit_code = RunUnlessInterrupted(*arguments); });
}

}  // namespace corvo
