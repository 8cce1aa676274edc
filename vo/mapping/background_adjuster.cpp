// SPDX-License-Identifier: MIT
#include "vo/mapping/background_adjuster.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace corvo {
namespace {

/// Returns the number of active keyframes in the segment of the newest one.
int CountActive(const Map& map) {
  const int segment = map.SegmentOf(map.num_keyframes() - 1);
  const std::vector<KeyframeId> active = map.ActiveKeyframes();
  return static_cast<int>(std::count_if(
      active.begin(), active.end(), [&](KeyframeId id) { return map.SegmentOf(id) == segment; }));
}

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

}  // namespace

BackgroundAdjuster::BackgroundAdjuster(const CameraPrior& prior, const OdometryOptions& options)
    : prior_(prior), options_(options) {
  prior_.Validate();
  if (!options.calibration.enabled) prior_.free.clear();
  estimate_ = PriorEstimate(prior_);
}

void BackgroundAdjuster::Start(int frame, const Map& map) {
  const KeyframeId newest = map.num_keyframes() - 1;
  if (window_.IsRunning() || newest == newest_) return;
  newest_ = newest;
  if (!calibration_.IsRunning() && CountActive(map) >= NextCalibration()) {
    StartCalibration(frame, map);
  }
  StartWindow(frame, map);
}

void BackgroundAdjuster::StartLastCalibration(int frame, const Map& map) {
  if (prior_rejected_ || newest_calibrated_ == map.num_keyframes() - 1) return;
  if (CountActive(map) >= options_.calibration.min_keyframes) StartCalibration(frame, map);
}

UsedAdjustments BackgroundAdjuster::UseResults(int frame, Map& map) {
  UsedAdjustments used;
  const bool calibrates = calibration_.IsDue(frame);
  // A window in progress refers to the camera and the map before the calibration.
  if (window_.IsDue(frame) || (calibrates && window_.IsRunning())) used.window = UseWindow(map);
  if (calibrates) used.camera = UseCalibration(map);
  return used;
}

int BackgroundAdjuster::NextCalibration() const {
  const CalibrationOptions& options = options_.calibration;
  const double growth = prior_rejected_ ? options.growth_after_rejection : options.growth;
  return std::max(options.min_keyframes, static_cast<int>(growth * num_calibrated_));
}

void BackgroundAdjuster::StartWindow(int frame, const Map& map) {
  window_.due_frame = frame + WindowLatency(map, options_.bundle_adjuster);
  window_.result = std::async(
      std::launch::async,
      [camera = map.camera(),
       adjuster = BundleAdjuster(WindowAdjustment(options_.bundle_adjuster))](Bundle&& bundle) {
        const AdjustmentSummary summary = adjuster.Adjust(camera, bundle);
        return Result{std::move(bundle), summary};
      },
      CopyBundle(map, SelectWindow(map, newest_, options_.bundle_adjuster)));
}

void BackgroundAdjuster::StartCalibration(int frame, const Map& map) {
  if (prior_.num_free() == 0) return;
  const CalibrationOptions& options = options_.calibration;
  num_calibrated_ = CountActive(map);
  newest_calibrated_ = map.num_keyframes() - 1;
  calibration_.due_frame =
      frame + std::min(options.max_latency_frames, num_calibrated_ + options.latency_frames);
  const AdjustmentWindow window = SelectNewestKeyframes(
      map, newest_calibrated_, options.max_keyframes, options_.bundle_adjuster);
  const int num_free = static_cast<int>(window.free.size());
  calibration_.result = std::async(
      std::launch::async,
      [prior = prior_, start = prior_.Apply(estimate_.difference),
       adjuster = BundleAdjuster(CalibrationAdjustment(options, num_free))](Bundle&& bundle) {
        std::vector<Bundle> bundles;
        bundles.push_back(std::move(bundle));
        const AdjustmentSummary summary = adjuster.Adjust(prior, start, bundles);
        return Result{std::move(bundles.front()), summary};
      },
      CopyBundle(map, window));
}

AdjustmentStatus BackgroundAdjuster::UseWindow(Map& map) {
  const Result result = window_.result.get();
  if (result.summary.is_usable()) WriteBack(result.bundle, map);
  return result.summary.status;
}

AdjustmentStatus BackgroundAdjuster::UseCalibration(Map& map) {
  const Result result = calibration_.result.get();
  if (!result.summary.is_usable()) return result.summary.status;
  prior_rejected_ = !prior_.PassesChiSquareTest(result.summary.estimate.difference);
  if (!prior_rejected_) WriteBack(result.bundle, map);
  estimate_ = prior_rejected_ ? PriorEstimate(prior_) : result.summary.estimate;
  const Camera camera(prior_.Apply(estimate_.difference));
  if (camera != map.camera()) {
    map.SetCamera(camera);
    newest_ = kNoId;  // The newest keyframes must be adjusted to the new camera.
  }
  return result.summary.status;
}

}  // namespace corvo
