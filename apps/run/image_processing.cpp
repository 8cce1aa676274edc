// SPDX-License-Identifier: MIT
#include "apps/run/image_processing.h"

#include <optional>

#include <fmt/format.h>

#include "apps/output/error_text.h"
#include "apps/run/image_names.h"
#include "apps/run/metric_result.h"
#include "apps/run/progress.h"
#include "apps/run/progress_line.h"
#include "apps/run/realtime_images.h"
#include "apps/run/stopwatch.h"
#include "vo/offline/expected_drift.h"

namespace corvo {
namespace {

constexpr int kFailed = 1;

/// Returns an empty record whose odometry reports to it.
RunRecord MakeRecord(const RunInputs& inputs, const RunArguments& arguments) {
  RunRecord record(Odometry(inputs.camera, inputs.options, arguments.threads));
  record.odometry.SetLandmarkCallback(
      [finished = record.finished.get()](const MarginalizedLandmark& landmark) {
        finished->Add(landmark);
      });
  record.odometry.SetObservationCallback(record.observations.Callback());
  if (arguments.keyframe_features) record.features.emplace();
  return record;
}

/// Returns what the latencies of all frames were.
RealtimeReport MakeReport(const RealtimeImages& images, const std::vector<FrameTiming>& timings) {
  RealtimeReport report{images.num_dropped(), {}};
  for (const FrameTiming& timing : timings) report.latencies_ms.push_back(*timing.latency_ms);
  return report;
}

RunEnd EndBySignal(int signal) {
  return {fmt::format("interrupted by {}", SignalName(signal)), ExitCodeOf(signal)};
}

FrameResult ProcessImage(const TimedImage& image, RunRecord& record) {
  if (image.missing == Reason::kNone) {
    return record.odometry.Process(image.image, image.time_ns, image.mask);
  }
  record.first_errors.try_emplace(image.missing, image.error);
  return record.odometry.ProcessMissing(image.time_ns, image.missing);
}

/// The processing of the images of one run.
class ImageLoop {
 public:
  ImageLoop(const RunArguments& arguments, const RunInputs& inputs, TrackDrawings& drawings,
            Checkpoint& checkpoint)
      : image_size_(inputs.camera.given.width, inputs.camera.given.height),
        names_(arguments.input, inputs.source.list()),
        progress_(inputs.source.expected_size().value_or(0)),
        drawings_(drawings),
        checkpoint_(checkpoint) {}

  /// Processes images one after the other until their end or a signal.
  void Run(ImageSource& source, const Interruption& interruption, RunRecord& record) {
    while (const std::optional<TimedImage> next = source.Next()) {
      Process(*next, record);
      if (interruption.IsRequested()) return;
    }
  }

  /// Like Run(), but takes the images when a camera would deliver them.
  void RunInRealtime(ImageSource& source, const Interruption& interruption, RunRecord& record) {
    RealtimeImages images(source, interruption);
    while (const std::optional<TimedImage> next = images.Next()) {
      Process(*next, record, &images);
      if (interruption.IsRequested()) break;
    }
    record.realtime = MakeReport(images, record.timings);
  }

 private:
  void Process(const TimedImage& next, RunRecord& record,
               const RealtimeImages* realtime = nullptr) {
    FrameTiming timing;
    timing.read_ms = watch_.LapMs();
    const FrameResult frame = ProcessImage(next, record);
    timing.total_ms = watch_.LapMs();
    if (realtime != nullptr) timing.latency_ms = realtime->LatencyMs();
    timing.stages = record.odometry.last_times();
    record.timings.push_back(timing);
    record.images.push_back(names_.Of(next));
    record.cameras.Update(frame, record.odometry);
    if (frame.is_keyframe) {
      record.colors.Add(record.odometry.last_frame(), next.color.empty() ? next.image : next.color);
    }
    if (record.features) record.features->Update(record.odometry.map());
    Draw(next, frame, record.odometry);
    progress_.Add(frame);
    checkpoint_.Update(record.odometry);
    watch_.LapMs();
  }

  void Draw(const TimedImage& next, const FrameResult& frame, const Odometry& odometry) {
    if (next.missing != Reason::kNone) {
      drawings_.AddMissing(image_size_, frame);
    } else {
      drawings_.Add(next.image, odometry.last_mask(), odometry.last_frame(), frame);
    }
  }

  cv::Size image_size_;
  ImageNames names_;
  ProgressReport progress_;
  TrackDrawings& drawings_;
  Checkpoint& checkpoint_;
  Stopwatch watch_;
};

void ProcessImages(const RunArguments& arguments, const Interruption& interruption,
                   RunInputs& inputs, TrackDrawings& drawings, Checkpoint& checkpoint,
                   RunRecord& record) {
  ImageLoop loop(arguments, inputs, drawings, checkpoint);
  if (arguments.realtime || inputs.source.is_live()) {
    loop.RunInRealtime(inputs.source, interruption, record);
  } else {
    loop.Run(inputs.source, interruption, record);
  }
  // The sequence of a live camera ends when the user stops it.
  if (interruption.IsRequested() && !inputs.source.is_live()) {
    record.end = EndBySignal(interruption.PendingSignal());
  }
}

/// Refines the recorded sequence as a whole and shows the progress. Interrupted, leaves the record
/// unrefined.
void RefineRecord(const Interruption& interruption, bool is_live, RunRecord& record) {
  ProgressLine line;
  const auto is_interrupted = [&] { return interruption.IsRequested() && !is_live; };
  Refinement refinement = Refine(record.odometry, record.observations, {}, [&](double share) {
    line.Show(share, "refining");
    return !is_interrupted();
  });
  if (is_interrupted()) {
    record.end = EndBySignal(interruption.PendingSignal());
    record.end.why += " before the trajectory was refined";
    return;
  }
  record.trajectory = refinement.trajectory;
  record.refinement = std::move(refinement);
}

}  // namespace

RunRecord ProcessSequence(const RunArguments& arguments, const Interruption& interruption,
                          RunInputs& inputs, TrackDrawings& drawings, Checkpoint& checkpoint) {
  RunRecord record = MakeRecord(inputs, arguments);
  Stopwatch watch;
  try {
    ProcessImages(arguments, interruption, inputs, drawings, checkpoint, record);
  } catch (const std::exception& error) {
    if (record.timings.empty()) throw;
    record.end = {ErrorText(error), kFailed};
  }
  record.trajectory = record.odometry.Finish();
  if (!record.trajectory.frames.empty()) {
    record.cameras.Update(record.trajectory.frames.back(), record.odometry);
  }
  if (arguments.refine && record.end.is_complete()) {
    RefineRecord(interruption, inputs.source.is_live(), record);
  }
  BringToMeters(arguments, record);
  record.graph =
      WithPosesOf(record.trajectory, MetersPerUnit(record), record.odometry.GetPoseGraph());
  record.elapsed_s = watch.ElapsedMs() / 1e3;
  const Map& map = record.odometry.map();
  record.check = CheckCalibration(map);
  WidenFocalLength(record.check, record.odometry.camera_prior(), map.camera().fx(), record.graph);
  SetExpectedDrift(record.graph, record.trajectory);
  return record;
}

}  // namespace corvo
