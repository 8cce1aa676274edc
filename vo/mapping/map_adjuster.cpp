#include "vo/mapping/map_adjuster.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "vo/optimization/bundle_adjuster.h"
#include "vo/optimization/bundle_calibrator.h"

namespace corvo {
namespace {

/// Kept keyframes of the newest one's segment.
int CountActive(const Map& map) {
  const int segment = map.SegmentOf(map.num_keyframes() - 1);
  const std::vector<KeyframeId> kept = map.ActiveKeyframes();
  return static_cast<int>(std::count_if(
      kept.begin(), kept.end(), [&](KeyframeId id) { return map.SegmentOf(id) == segment; }));
}

/// Frames between the newest keyframe and the kept one before it, in its segment; or 0.
int NewestSpacing(const Map& map) {
  const std::vector<KeyframeId> kept = map.ActiveKeyframes();
  const Keyframe& newest = map.keyframe(kept.back());
  if (kept.size() < 2) return 0;
  const Keyframe& before = map.keyframe(kept[kept.size() - 2]);
  return before.segment == newest.segment ? newest.frame.index - before.frame.index : 0;
}

/// Few where keyframes follow each other fast: what they see is lost before it is adjusted, and
/// with it the scale.
int WindowLatency(const Map& map, const BundleAdjusterOptions& options) {
  return std::clamp(NewestSpacing(map) - 1, options.min_latency_frames, options.max_latency_frames);
}

}  // namespace

MapAdjuster::MapAdjuster(const CameraPrior& prior, const OdometryOptions& options)
    : prior_(prior), options_(options) {
  prior_.Validate();
  if (!options.calibration.enabled) prior_.free.clear();
  estimate_ = PriorEstimate(prior_);
}

void MapAdjuster::Start(const Map& map, int frame) {
  const KeyframeId newest = map.num_keyframes() - 1;
  if (window_.result.valid() || newest == newest_) return;
  newest_ = newest;
  if (!calibration_.result.valid() && CountActive(map) >= NextCalibration()) {
    StartCalibration(map, frame);
  }
  window_.due_frame = frame + WindowLatency(map, options_.bundle_adjuster);
  window_.result = std::async(
      std::launch::async,
      [camera = map.camera(), options = options_.bundle_adjuster](Bundle&& bundle) {
        AdjustBundle(camera, options, bundle);
        return std::move(bundle);
      },
      CopyBundle(map, SelectWindow(map, newest, options_.bundle_adjuster)));
}

void MapAdjuster::StartLastCalibration(const Map& map, int frame) {
  if (prior_rejected_ || newest_calibrated_ == map.num_keyframes() - 1) return;
  if (CountActive(map) >= options_.calibration.min_keyframes) StartCalibration(map, frame);
}

int MapAdjuster::NextCalibration() const {
  const CalibrationOptions& options = options_.calibration;
  const double growth = prior_rejected_ ? options.growth_after_rejection : options.growth;
  return std::max(options.min_keyframes, static_cast<int>(growth * num_calibrated_));
}

void MapAdjuster::StartCalibration(const Map& map, int frame) {
  if (prior_.num_free() == 0) return;
  num_calibrated_ = CountActive(map);
  newest_calibrated_ = map.num_keyframes() - 1;
  calibration_.due_frame = frame + std::min(options_.calibration.max_latency_frames,
                                            num_calibrated_ + options_.calibration.latency_frames);
  const AdjustmentWindow window = SelectNewestKeyframes(
      map, newest_calibrated_, options_.calibration.max_keyframes, options_.bundle_adjuster);
  calibration_.result = std::async(
      std::launch::async,
      [prior = prior_, start = estimate_.difference,
       options = options_.calibration](Bundle&& bundle) {
        Calibrated result{std::move(bundle), std::nullopt};
        result.estimate = CalibrateBundle(prior, start, options, result.bundle);
        return result;
      },
      CopyBundle(map, window));
}

bool MapAdjuster::Finish(int frame, Map& map) {
  const bool calibrates = calibration_.IsDue(frame);
  // A window is about the camera and the map before the calibration.
  const bool adjusts = window_.IsDue(frame) || (calibrates && window_.result.valid());
  if (adjusts) WriteBack(window_.result.get(), map);
  if (calibrates) FinishCalibration(map);
  return adjusts || calibrates;
}

void MapAdjuster::FinishCalibration(Map& map) {
  const Calibrated result = calibration_.result.get();
  if (!result.estimate) return;
  prior_rejected_ = !prior_.PassesChiSquareTest(result.estimate->difference);
  if (!prior_rejected_) WriteBack(result.bundle, map);
  estimate_ = prior_rejected_ ? PriorEstimate(prior_) : *result.estimate;
  const Camera camera(prior_.Apply(estimate_.difference));
  if (camera == map.camera()) return;
  map.SetCamera(camera);
  newest_ = kNoId;  // What is newer is to be adjusted to it.
}

}  // namespace corvo
