// SPDX-License-Identifier: MIT
#include "vo/mapping/background_adjuster.h"

#include <algorithm>
#include <utility>
#include <vector>

#include <Eigen/LU>

#include "vo/mapping/keyframe_location.h"
#include "vo/optimization/point_selection.h"

namespace corvo {
namespace {

/// Returns the number of frames from the previous active keyframe to the newest, or 0 if there is
/// none in the segment.
int NewestSpacing(const Map& map) {
  const std::vector<KeyframeId> active = map.ActiveKeyframes();
  const Keyframe& newest = map.keyframe(active.back());
  if (active.size() < 2) return 0;
  const Keyframe& before = map.keyframe(active[active.size() - 2]);
  return before.segment == newest.segment ? newest.frame.index - before.frame.index : 0;
}

/// Returns the latency of a window's adjustment. It is short if keyframes follow each other
/// quickly: otherwise their landmarks would be lost before they are adjusted, and the scale with
/// them.
int WindowLatency(const Map& map, const BundleAdjusterOptions& options) {
  return std::clamp(NewestSpacing(map) - 1, options.min_latency_frames, options.max_latency_frames);
}

/// Returns the prior, without free parameters if the camera is not to be estimated.
CameraPrior CheckedPrior(CameraPrior prior, const CalibrationOptions& options) {
  prior.Validate();
  if (!options.enabled) prior.free.clear();
  return prior;
}

/// Returns whether an estimate is less certain than another, as a whole, although no disagreement
/// has been found: an adjustment that converged worse.
bool IsLessCertain(const CameraEstimate& estimate, const CameraEstimate& than) {
  return estimate.is_consistent &&
         estimate.covariance.determinant() > than.covariance.determinant();
}

}  // namespace

BackgroundAdjuster::BackgroundAdjuster(const CameraPrior& prior, const OdometryOptions& options)
    : prior_(CheckedPrior(prior, options.calibration)),
      options_(options),
      intermediate_(options.bundle_adjuster.max_keyframes,
                    options.bundle_adjuster.intermediate_frames),
      finished_(prior_, options.calibration.stated_share),
      estimate_(finished_.Estimate()),
      adjusted_to_(prior_.given) {}

void BackgroundAdjuster::Start(int frame, const Map& map) {
  const KeyframeId newest = map.num_keyframes() - 1;
  if (window_.IsRunning() || newest == newest_) return;
  newest_ = newest;
  if (!calibration_.IsRunning()) {
    EnterSegment(map);
    if (IsCalibrationDue(map)) StartCalibration(frame, map);
  }
  StartWindow(frame, map);
}

void BackgroundAdjuster::StartLastCalibration(int frame, const Map& map) {
  EnterSegment(map);
  if (prior_rejected_ || block_.newest == map.num_keyframes() - 1) return;
  const int num_keyframes = static_cast<int>(KeyframesOfBlock(map).size());
  if (num_keyframes >= options_.calibration.min_keyframes) StartCalibration(frame, map);
}

UsedAdjustments BackgroundAdjuster::UseResults(int frame, Map& map) {
  UsedAdjustments used;
  const bool calibrates = calibration_.IsDue(frame);
  // A window in progress refers to the camera and the map before the calibration.
  if (window_.IsDue(frame) || (calibrates && window_.IsRunning())) used.window = UseWindow(map);
  if (calibrates) used.camera = UseCalibration(map);
  return used;
}

void BackgroundAdjuster::EnterSegment(const Map& map) {
  KeyframeId first = map.num_keyframes() - 1;
  const int segment = map.SegmentOf(first);
  if (segment == block_.segment) return;
  // Keyframes of earlier visits to the segment belong to other blocks.
  while (first > block_.first && first > block_.newest + 1 && map.SegmentOf(first - 1) == segment) {
    --first;
  }
  EndBlock(first, segment);
}

void BackgroundAdjuster::EndBlock(KeyframeId first, int segment) {
  if (block_.information.matrix.size() > 0) finished_.Add(block_.information);
  num_finished_keyframes_ += block_.num_keyframes;
  block_ = Block();
  block_.first = first;
  block_.segment = segment;
}

std::vector<KeyframeId> BackgroundAdjuster::KeyframesOfBlock(const Map& map) const {
  std::vector<KeyframeId> keyframes = map.ActiveKeyframes();
  std::erase_if(keyframes, [&](KeyframeId id) {
    return id < block_.first || map.SegmentOf(id) != block_.segment;
  });
  return keyframes;
}

bool BackgroundAdjuster::IsCalibrationDue(const Map& map) const {
  const CalibrationOptions& options = options_.calibration;
  const int num_keyframes = static_cast<int>(KeyframesOfBlock(map).size());
  if (num_keyframes < options.min_keyframes) return false;
  if (num_keyframes >= options.block_keyframes) return true;
  const double growth = prior_rejected_ ? options.growth_after_rejection : options.growth;
  const int num_estimated = num_finished_keyframes_ + block_.num_keyframes;
  return num_finished_keyframes_ + num_keyframes >= static_cast<int>(growth * num_estimated);
}

void BackgroundAdjuster::StartWindow(int frame, const Map& map) {
  window_.due_frame = frame + WindowLatency(map, options_.bundle_adjuster);
  Bundle bundle = CopyBundle(map, SelectWindow(map, newest_, options_.bundle_adjuster));
  intermediate_.AddTo(map, bundle);
  window_.result = std::async(
      std::launch::async,
      [camera = map.camera(), free = prior_.free,
       adjuster = BundleAdjuster(WindowAdjustment(options_.bundle_adjuster)),
       points_per_view = options_.bundle_adjuster.points_per_keyframe](Bundle&& window) {
        const AdjustmentSummary summary = adjuster.Adjust(camera, window);
        KeyframeCovariance covariance = CovarianceOfViews({camera.parameters(), free}, window,
                                                          SelectPoints(window, points_per_view));
        IntermediateFrames::RemoveFrom(window);
        return Result{std::move(window), summary, std::move(covariance)};
      },
      std::move(bundle));
}

void BackgroundAdjuster::StartCalibration(int frame, const Map& map) {
  if (prior_.num_free() == 0) return;
  const CalibrationOptions& options = options_.calibration;
  const std::vector<KeyframeId> keyframes = KeyframesOfBlock(map);
  block_.num_keyframes = static_cast<int>(keyframes.size());
  block_.newest = keyframes.back();
  calibration_.due_frame =
      frame + std::min(options.max_latency_frames, block_.num_keyframes + options.latency_frames);
  CameraEstimator estimator(
      prior_, estimate_, options, finished_,
      CopyBundle(map, {keyframes, {}, map.FindObserved(keyframes)}),
      CopyBundle(map, SelectNewestKeyframes(map, block_.newest, options.max_keyframes,
                                            options_.bundle_adjuster)),
      adjusted_to_);
  calibration_.result = std::async(std::launch::async, std::move(estimator));
}

AdjustmentStatus BackgroundAdjuster::UseWindow(Map& map) {
  Result result = window_.result.get();
  if (result.summary.is_usable()) WriteBack(result.bundle, map);
  window_covariance_ = std::move(result.covariance);
  return result.summary.status;
}

AdjustmentStatus BackgroundAdjuster::UseCalibration(Map& map) {
  const CalibratedBundle result = calibration_.result.get();
  const bool is_used = IsUsable(result.status) && !IsLessCertain(result.estimate, estimate_);
  if (is_used) block_.information = result.of_block;
  if (block_.num_keyframes >= options_.calibration.block_keyframes) {
    EndBlock(block_.newest + 1, block_.segment);
  }
  if (!is_used) return result.status;
  prior_rejected_ = !prior_.PassesChiSquareTest(result.estimate.difference);
  estimate_ = prior_rejected_ ? PriorEstimate(prior_) : result.estimate;
  map.SetCamera(Camera(prior_.Apply(estimate_.difference)));
  if (prior_rejected_ || !result.bundle) return result.status;
  WriteBack(*result.bundle, map);
  // Keyframes that were inserted since have poses by the camera of before; the next window adjusts
  // them to the new one.
  LocateNewerKeyframes(*result.bundle, options_, map);
  adjusted_to_ = map.camera();
  newest_ = kNoId;
  return result.status;
}

}  // namespace corvo
