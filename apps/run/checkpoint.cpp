// SPDX-License-Identifier: MIT
#include "apps/run/checkpoint.h"

#include <algorithm>

#include <spdlog/spdlog.h>

#include "apps/output/frame_tables.h"
#include "apps/output/json_text.h"
#include "apps/output/reasons.h"
#include "apps/output/segment_report.h"
#include "apps/run/outcome.h"
#include "apps/run/trajectory_file.h"
#include "apps/system/durable_file.h"
#include "vo/offline/metric_scale.h"

namespace corvo {
namespace {

constexpr double kIntervalPerDuration = 20;

nlohmann::ordered_json Describe(const RunArguments& arguments, const RunInputs& inputs,
                                const Trajectory& trajectory, const std::string& why) {
  nlohmann::ordered_json json = {{"complete", false},
                                 {"ended_by", why},
                                 {"outcome", "incomplete"},
                                 {"input", arguments.input.string()},
                                 {"layout", inputs.source.list().layout},
                                 {"frames", trajectory.frames.size()},
                                 {"frames_expected", nullptr},
                                 {"posed", CountPosedFrames(trajectory)},
                                 {"segments", ToJson(trajectory.Segments())},
                                 {"reasons", nlohmann::ordered_json::object()}};
  if (const auto size = inputs.source.size()) json["frames_expected"] = *size;
  for (const auto& [reason, count] : CountReasons(trajectory)) {
    json["reasons"][std::string(ToString(reason))] = count;
  }
  return json;
}

/// Returns the trajectory in meters if --meters-per-unit says how long its unit is. Any other scale
/// is known at the end only.
Trajectory InGivenUnit(const RunArguments& arguments, Trajectory trajectory) {
  if (!arguments.meters_per_unit) return trajectory;
  const MetricTransform metric(trajectory, ConstantScale(trajectory, *arguments.meters_per_unit));
  return metric.Apply(std::move(trajectory));
}

}  // namespace

Checkpoint::Checkpoint(const RunArguments& arguments, const RunInputs& inputs,
                       const OutputFolder& output, double min_interval_ms)
    : arguments_(arguments),
      inputs_(inputs),
      output_(output),
      min_interval_ms_(min_interval_ms),
      due_ms_(min_interval_ms) {}

void Checkpoint::Update(const Odometry& odometry) {
  const double start_ms = watch_.ElapsedMs();
  if (start_ms < due_ms_) return;
  try {
    Save(odometry, "unknown: this is a checkpoint of a running process");
  } catch (const std::exception& error) {
    if (!has_warned_) spdlog::warn("no checkpoint was saved: {}", error.what());
    has_warned_ = true;
  }
  const double end_ms = watch_.ElapsedMs();
  due_ms_ = end_ms + std::max(min_interval_ms_, kIntervalPerDuration * (end_ms - start_ms));
}

void Checkpoint::Save(const Odometry& odometry, const std::string& why) const {
  const Trajectory trajectory = InGivenUnit(arguments_, odometry.GetTrajectory());
  WriteTrajectory(output_.StageCheckpoint("trajectory.tum"), trajectory);
  WriteFile(output_.StageCheckpoint("frames.csv"), FrameTable(trajectory));
  WriteFile(output_.StageCheckpoint("summary.json"),
            JsonText(Describe(arguments_, inputs_, trajectory, why)));
  output_.SaveCheckpoint();
}

}  // namespace corvo
