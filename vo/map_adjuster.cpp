#include "vo/map_adjuster.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "vo/bundle_adjuster.h"
#include "vo/bundle_calibrator.h"

namespace corvo {
namespace {

/// Kept keyframes of a segment.
int CountKept(const Map& map, int segment) {
  const std::vector<KeyframeId> kept = map.KeptKeyframes();
  return static_cast<int>(std::count_if(
      kept.begin(), kept.end(), [&](KeyframeId id) { return map.SegmentOf(id) == segment; }));
}

/// Frames between the newest keyframe and the kept one before it, in its segment; or 0.
int NewestSpacing(const Map& map) {
  const std::vector<KeyframeId> kept = map.KeptKeyframes();
  const Keyframe& newest = map.keyframe(kept.back());
  if (kept.size() < 2) return 0;
  const Keyframe& before = map.keyframe(kept[kept.size() - 2]);
  return before.segment == newest.segment ? newest.frame.index - before.frame.index : 0;
}

/// Few where keyframes follow each other fast: what they see is lost before it is adjusted, and
/// with it the scale.
int FramesBesideWindow(const Map& map) { return std::clamp(NewestSpacing(map) / 2, 2, 4); }

}  // namespace

MapAdjuster::MapAdjuster(const CameraPrior& prior, const OdometryOptions& options)
    : prior_(prior), camera_(prior.given), options_(options) {
  prior_.Validate();
  if (!options.calibration.enabled) prior_.free.clear();
  estimate_ = PriorEstimate(prior_);
}

void MapAdjuster::Start(const Map& map, const KeypointNoise& noise, int frame) {
  const KeyframeId newest = map.num_keyframes() - 1;
  if (window_.result.valid() || newest == newest_) return;
  newest_ = newest;
  const int num_keyframes = CountKept(map, map.SegmentOf(newest));
  if (IsCalibrationDue(num_keyframes)) {
    num_calibrated_ = num_keyframes;
    StartCalibration(map, noise, frame);
  }
  window_.due_frame = frame + FramesBesideWindow(map);
  window_.result = std::async(
      std::launch::async,
      [camera = camera_, options = options_.bundle_adjuster](Bundle&& bundle) {
        AdjustBundle(camera, options, bundle);
        return std::move(bundle);
      },
      CopyBundle(map, SelectWindow(map, newest, options_.bundle_adjuster), noise));
}

bool MapAdjuster::IsCalibrationDue(int num_keyframes) const {
  constexpr int kMinKeyframes = 8;
  if (prior_.num_free() == 0 || calibration_.result.valid()) return false;
  return num_keyframes >= std::max(kMinKeyframes, num_calibrated_ * 4 / 3);
}

void MapAdjuster::StartCalibration(const Map& map, const KeypointNoise& noise, int frame) {
  constexpr int kMaxFramesBeside = 20;
  calibration_.due_frame = frame + std::min(kMaxFramesBeside, num_calibrated_ + 2);
  const AdjustmentWindow window = SelectNewestKeyframes(
      map, newest_, options_.calibration.max_keyframes, options_.bundle_adjuster);
  calibration_.result = std::async(
      std::launch::async,
      [prior = prior_, start = estimate_.difference, options = options_](const Bundle& bundle) {
        return Calibrate(prior, start, options, bundle);
      },
      CopyBundle(map, window, noise));
}

/// Adjusts the camera too, if it stays within its prior.
MapAdjuster::Calibrated MapAdjuster::Calibrate(const CameraPrior& prior,
                                               const Eigen::VectorXd& start,
                                               const OdometryOptions& options,
                                               const Bundle& bundle) {
  Calibrated result{bundle, std::nullopt, false};
  result.estimate = CalibrateBundle(prior, start, options.calibration, result.bundle);
  if (!result.estimate || prior.Allows(result.estimate->difference)) return result;
  result = {bundle, PriorEstimate(prior), true};
  AdjustBundle(Camera(prior.given), options.bundle_adjuster, result.bundle);
  return result;
}

bool MapAdjuster::Finish(Map& map, int frame) {
  const bool calibrates = calibration_.IsDue(frame);
  // A window is about the camera and the map before the calibration.
  const bool adjusts = window_.IsDue(frame) || (calibrates && window_.result.valid());
  if (adjusts) WriteBack(window_.result.get(), map);
  if (calibrates) FinishCalibration(map);
  return adjusts || calibrates;
}

void MapAdjuster::FinishCalibration(Map& map) {
  const Calibrated result = calibration_.result.get();
  WriteBack(result.bundle, map);
  newest_ = kNoId;  // What is newer is to be adjusted to it.
  contradicts_prior_ = result.contradicts_prior;
  if (!result.estimate) return;
  estimate_ = *result.estimate;
  camera_ = Camera(prior_.Apply(estimate_.difference));
  map.UpdateRays(camera_);
}

}  // namespace corvo
