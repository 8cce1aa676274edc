// SPDX-License-Identifier: MIT
#include "bench/odometry/trial.h"

#include <cmath>
#include <limits>
#include <optional>

#include "apps/run/outcome.h"
#include "bench/clocks.h"
#include "orb/error.h"
#include "vo/evaluation/evaluation.h"
#include "vo/odometry.h"
#include "vo/offline/refiner.h"

namespace corvo::bench {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

void CountFrames(const Trajectory& trajectory, TrialResult& result) {
  bool was_posed = false;
  for (const FrameResult& frame : trajectory.frames) {
    const bool is_posed = frame.world_from_camera.has_value();
    result.losses += was_posed && !is_posed;
    was_posed = is_posed;
  }
  result.frames = static_cast<int>(trajectory.frames.size());
  result.posed_share = trajectory.PosedShare();
  result.rotation_share = static_cast<double>(trajectory.Rotations().size()) / result.frames;
  result.segments = CountPosedSegments(trajectory);
}

void MeasureRotation(const Trajectory& trajectory, const PoseSequence& truth, TrialResult& result) {
  const PoseSequence rotations = trajectory.Rotations();
  const auto pairs = Associate(rotations, truth, HalfFrame(rotations));
  if (!pairs.empty()) {
    result.rotation_deg = RelativeErrorOverTime(pairs, 1'000'000'000).rotation_deg.rmse;
  }
}

void MeasurePoses(const Evaluation& evaluation, TrialResult& result) {
  result.ate = evaluation.absolute.rmse;
  result.rpe = evaluation.relative_frames.translation.rmse;
  if (evaluation.kitti) {
    result.t_rel_percent = evaluation.kitti->t_rel_percent;
    result.r_rel_deg_per_100m = evaluation.kitti->r_rel_deg_per_100m;
  }
  if (evaluation.scale_drift) {
    result.scale_drift = evaluation.scale_drift->last_over_first;
    result.scale_percent_per_km = evaluation.scale_drift->percent_per_km;
  }
}

/// Returns std::nullopt if the poses are too few to be aligned with the ground truth.
std::optional<Evaluation> EvaluateIfPossible(const PoseSequence& poses, const PoseSequence& truth) {
  if (truth.empty()) return std::nullopt;
  try {
    return Evaluate(poses, truth);
  } catch (const Error&) {
    return std::nullopt;
  }
}

TrialResult Evaluated(const Trajectory& trajectory, const PoseSequence& truth) {
  TrialResult result;
  result.ate = result.live_ate = result.t_rel_percent = result.r_rel_deg_per_100m = result.rpe =
      kUnknown;
  result.rotation_deg = result.scale_drift = result.scale_percent_per_km = kUnknown;
  CountFrames(trajectory, result);
  if (truth.empty()) return result;
  MeasureRotation(trajectory, truth, result);
  if (const auto evaluation = EvaluateIfPossible(trajectory.PosedFrames(), truth)) {
    MeasurePoses(*evaluation, result);
  }
  return result;
}

}  // namespace

TrialResult RunTrial(const Recording& recording, const OdometryOptions& options, bool refine) {
  Odometry odometry(recording.camera, options);
  ObservationLog log;
  if (refine) odometry.SetObservationCallback(log.Callback());
  PoseSequence live_poses;
  double wall_ms = 0, processor_ms = 0;
  for (int i = 0; i < recording.size(); ++i) {
    const cv::Mat image = recording.image(i);
    const double wall = WallTimeMs(), processor = ProcessTimeMs();
    const FrameResult frame = odometry.Process(image, recording.times[i]);
    wall_ms += WallTimeMs() - wall;
    processor_ms += ProcessTimeMs() - processor;
    if (frame.world_from_camera) live_poses.push_back({frame.time_ns, *frame.world_from_camera});
  }
  Trajectory trajectory = odometry.Finish();
  if (refine) trajectory = Refine(odometry, log).trajectory;
  TrialResult result = Evaluated(trajectory, recording.truth);
  if (const auto live = EvaluateIfPossible(live_poses, recording.truth)) {
    result.live_ate = live->absolute.rmse;
  }
  result.wall_ms = wall_ms / result.frames;
  result.processor_ms = processor_ms / result.frames;
  return result;
}

}  // namespace corvo::bench
