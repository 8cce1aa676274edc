// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "vo/camera/camera_prior.h"
#include "vo/core/options.h"
#include "vo/core/stage_times.h"
#include "vo/map/initial_map.h"
#include "vo/map/map.h"
#include "vo/map/observation_recorder.h"
#include "vo/mapping/background_adjuster.h"

namespace corvo {

/// What an update of the map changed, for those who keep poses relative to its keyframes.
struct MapUpdate {
  UsedAdjustments adjustments;     ///< If any, poses, points and the camera may have changed.
  std::vector<KeyframeId> culled;  ///< In ascending order.
};

/// Extends a map by keyframes and landmarks, adjusts it and removes from it what is of no more use.
/// Adjustments run beside the frames that follow; their results are used at fixed frames, so that
/// they do not depend on the speed of the machine.
class Mapper {
 public:
  /// Throws corvo::Error on a prior that is not valid.
  Mapper(const CameraPrior& prior, const OdometryOptions& options);

  /// Makes two frames the first keyframes of a segment, with landmarks at the points of an initial
  /// map in the unit of the segment. The first frame has its pose; the second one gets it.
  /// Returns the first keyframe; the second is the next one.
  KeyframeId InsertInitialMap(const InitialMap& initial, int segment, Frame& first, Frame& second,
                              Map& map);

  /// Makes a tracked frame a keyframe, culls landmarks that failed their probation and creates
  /// those that the keyframe observes. Update fuses them, so that no frame waits for both.
  KeyframeId InsertKeyframe(Frame& frame, int segment, Map& map);

  /// The work of one frame: uses the results of adjustments that are due, culls and marginalizes
  /// keyframes, fuses landmarks around the newest keyframe and starts the next adjustment.
  MapUpdate Update(int frame, Map& map, ObservationRecorder& recorder, StageClock& clock);

  /// Finishes all work that has been started, waiting for it.
  MapUpdate Finish(Map& map, ObservationRecorder& recorder, StageClock& clock);

  /// Starts an adjustment around the newest keyframe, if it has had none with the present camera.
  void StartAdjustment(int frame, const Map& map) { adjuster_.Start(frame, map); }
  /// Starts an estimate of the camera after the last frame, if newer keyframes have not been used.
  void StartLastCalibration(int frame, const Map& map) {
    adjuster_.StartLastCalibration(frame, map);
  }

  /// Marginalizes the keyframes that nothing searches any more.
  void Marginalize(Map& map, const ObservationRecorder& recorder) const;

  /// How far the camera is from what was given, and how certain it is.
  const CameraEstimate& camera_estimate() const { return adjuster_.camera_estimate(); }
  const CameraPrior& camera_prior() const { return adjuster_.camera_prior(); }
  /// Whether the images do not fit the given camera within its standard deviations.
  bool prior_rejected() const { return adjuster_.prior_rejected(); }

 private:
  MapUpdate UseAdjustments(int frame, Map& map, const ObservationRecorder& recorder,
                           StageClock& clock);
  /// Fuses landmarks around the newest keyframe, if that has not been done.
  void FuseLandmarks(Map& map, ObservationRecorder& recorder);

  OdometryOptions options_;
  BackgroundAdjuster adjuster_;
  KeyframeId unfused_ = kNoId;         // The keyframe around which landmarks are to be fused.
  std::vector<LandmarkId> probation_;  // New landmarks, which have to prove themselves.
};

}  // namespace corvo
