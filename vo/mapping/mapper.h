// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "vo/camera/camera_prior.h"
#include "vo/core/options.h"
#include "vo/core/stage_times.h"
#include "vo/map/initial_map.h"
#include "vo/map/map.h"
#include "vo/map/observation_recorder.h"
#include "vo/map/pose_graph.h"
#include "vo/mapping/background_adjuster.h"
#include "vo/mapping/keyframe_edges.h"
#include "vo/mapping/pose_uncertainty.h"

namespace corvo {

/// The changes in an update of the map, for users that store poses relative to its keyframes.
struct MapUpdate {
  UsedAdjustments adjustments;     ///< If any, poses, points and the camera may have changed.
  std::vector<KeyframeId> culled;  ///< Culled keyframes in ascending order.
};

/// Extends a map by keyframes and landmarks, adjusts it and removes what is no longer useful.
/// Adjustments run in parallel to the following frames. Their results are applied at fixed frames,
/// so that the map does not depend on the speed of the machine.
class Mapper {
 public:
  /// Throws corvo::Error if the prior is invalid.
  Mapper(const CameraPrior& prior, const OdometryOptions& options);

  /// Makes two frames the first keyframes of a segment, with landmarks at the points of an initial
  /// map in the unit of the segment. The first frame must have its pose; that of the second is set.
  /// Returns the first keyframe; the id of the second is one higher.
  KeyframeId InsertInitialMap(const InitialMap& initial, int segment, Frame& first, Frame& second,
                              Map& map);

  /// Makes a tracked frame a keyframe, culls landmarks that failed their probation and creates
  /// landmarks that the keyframe observes. Returns the keyframe. Update() fuses the landmarks, so
  /// that no single frame waits for both.
  KeyframeId InsertKeyframe(Frame& frame, int segment, Map& map);

  /// Adds a posed frame of a segment, which improves the adjustments if it is not a keyframe.
  void AddFrame(const Frame& frame, int segment, const Map& map) {
    adjuster_.AddFrame(frame, segment, map);
  }

  /// Adapts to a join of segments, which has merged landmarks around the newest keyframe: the next
  /// Update() fuses others there, as after its insertion.
  void AdaptToJoin(const SegmentJoin& join, const Map& map);

  /// Returns the graph of all keyframes so far.
  PoseGraph GetPoseGraph(const Map& map) const;
  std::size_t num_edge_bytes() const { return edges_.num_bytes(); }
  /// Returns the memory of the frames that later adjustments use.
  std::size_t num_frame_bytes() const { return adjuster_.num_frame_bytes(); }

  /// Returns the uncertainty of a located frame relative to a keyframe: of the newest keyframe
  /// relative to the one before it, of any other frame relative to the newest one. Returns
  /// std::nullopt if it is unknown.
  std::optional<UncertaintyToKeyframe> UncertaintyOf(const Frame& frame, const Map& map);

  /// Does the work of one frame: applies the results of adjustments that are due, culls and
  /// marginalizes keyframes, fuses landmarks around the newest keyframe and starts the next
  /// adjustment.
  MapUpdate Update(int frame, Map& map, ObservationRecorder& recorder, StageClock& clock);

  /// Waits for all work that has been started and applies its results.
  MapUpdate Finish(Map& map, ObservationRecorder& recorder, StageClock& clock);

  /// Starts an adjustment around the newest keyframe, unless one with the current camera was
  /// started.
  void StartAdjustment(int frame, const Map& map) { adjuster_.Start(frame, map); }
  /// Starts an estimate of the camera after the last frame, if there are keyframes that no estimate
  /// has used.
  void StartLastCalibration(int frame, const Map& map) {
    adjuster_.StartLastCalibration(frame, map);
  }

  /// Marginalizes the keyframes that are no longer searched.
  void Marginalize(Map& map, const ObservationRecorder& recorder) const;

  /// Returns the camera's difference from the given one, with its covariance.
  const CameraEstimate& camera_estimate() const { return adjuster_.camera_estimate(); }
  const CameraPrior& camera_prior() const { return adjuster_.camera_prior(); }
  /// Returns whether the images contradict the given camera beyond its standard deviations.
  bool prior_rejected() const { return adjuster_.prior_rejected(); }

 private:
  MapUpdate UseAdjustments(int frame, Map& map, const ObservationRecorder& recorder,
                           StageClock& clock);
  /// Fuses landmarks around the newest keyframe, unless that has been done.
  void FuseLandmarks(Map& map, ObservationRecorder& recorder);

  OdometryOptions options_;
  BackgroundAdjuster adjuster_;
  PoseUncertainty uncertainty_;
  KeyframeEdges edges_;
  KeyframeId unfused_ = kNoId;         // Keyframe around which landmarks are yet to be fused.
  std::vector<LandmarkId> probation_;  // New landmarks that are on probation.
};

}  // namespace corvo
