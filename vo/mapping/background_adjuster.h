// SPDX-License-Identifier: MIT
#pragma once

#include <future>
#include <vector>

#include "vo/camera/camera.h"
#include "vo/camera/camera_prior.h"
#include "vo/core/adjustment_status.h"
#include "vo/core/conventions.h"
#include "vo/core/options.h"
#include "vo/map/map.h"
#include "vo/mapping/camera_blocks.h"
#include "vo/mapping/camera_estimator.h"
#include "vo/mapping/intermediate_frames.h"
#include "vo/optimization/bundle_adjuster.h"
#include "vo/optimization/keyframe_covariance.h"

namespace corvo {

/// Adjusts a map on threads of its own, in parallel to the following frames: the window of each new
/// keyframe and, whenever the number of keyframes has grown by a factor or a block of keyframes is
/// complete, that block together with the camera. The camera is estimated from all blocks, see
/// CameraBlocks, and the newest keyframes are adjusted to it. At most one adjustment of each kind
/// runs at a time. Results are applied at fixed frames, however long they took, so that the map
/// does not depend on timing.
class BackgroundAdjuster {
 public:
  /// Throws corvo::Error if the prior is invalid.
  BackgroundAdjuster(const CameraPrior& prior, const OdometryOptions& options);

  /// Adds a posed frame of a segment: if it is not the newest keyframe, later windows use what it
  /// observes.
  void AddFrame(const Frame& frame, int segment, const Map& map) {
    intermediate_.Add(frame, segment, map);
  }

  /// Adapts to a join of segments.
  void AdaptToJoin() { intermediate_.Clear(); }

  /// Starts an adjustment around the newest keyframe after `frame`, unless that has been started
  /// already or the result of the previous adjustment has not been applied.
  void Start(int frame, const Map& map);

  /// Starts an estimate of the camera after the last frame, if there are keyframes that no estimate
  /// has used. The result of the previous one must have been applied.
  void StartLastCalibration(int frame, const Map& map);

  /// Waits for the results that are due before `frame` and applies them to the map: poses, points
  /// and the camera.
  UsedAdjustments UseResults(int frame, Map& map);

  /// Returns the memory of the frames that later windows use.
  std::size_t num_frame_bytes() const { return intermediate_.num_bytes(); }

  /// Returns the joint covariance of the window that was used last.
  const KeyframeCovariance& window_covariance() const { return window_covariance_; }

  const CameraEstimate& camera_estimate() const { return estimate_; }
  const CameraPrior& camera_prior() const { return prior_; }
  /// Returns whether the images contradict the given camera beyond its sigmas; it is then used as
  /// given.
  bool prior_rejected() const { return prior_rejected_; }

 private:
  struct Result {
    Bundle bundle;
    AdjustmentSummary summary;
    KeyframeCovariance covariance;
  };
  /// An adjustment, in progress while `result` is valid.
  template <typename Outcome>
  struct Job {
    std::future<Outcome> result;
    int due_frame = 0;

    bool IsRunning() const { return result.valid(); }
    bool IsDue(int frame) const { return IsRunning() && frame >= due_frame; }
  };

  /// The keyframes of one segment since the previous block, and what they tell of the camera.
  struct Block {
    KeyframeId first = 0;  // No keyframe before it belongs to the block.
    int segment = 0;
    int num_keyframes = 0;  // At the newest estimate, as the following.
    KeyframeId newest = kNoId;
    CameraInformation information;
  };

  /// Ends the block if the newest keyframe belongs to another segment.
  void EnterSegment(const Map& map);
  /// Ends the block and starts one of `segment`, with keyframes from `first` on.
  void EndBlock(KeyframeId first, int segment);
  /// Returns the block's active keyframes, in ascending order.
  std::vector<KeyframeId> KeyframesOfBlock(const Map& map) const;
  bool IsCalibrationDue(const Map& map) const;

  void StartWindow(int frame, const Map& map);
  void StartCalibration(int frame, const Map& map);
  AdjustmentStatus UseWindow(Map& map);
  AdjustmentStatus UseCalibration(Map& map);

  CameraPrior prior_;
  OdometryOptions options_;
  Job<Result> window_;
  Job<CalibratedBundle> calibration_;
  IntermediateFrames intermediate_;
  KeyframeCovariance window_covariance_;
  KeyframeId newest_ = kNoId;  // Keyframe whose window was adjusted last with the current camera.
  CameraBlocks finished_;      // All but the newest block.
  CameraEstimate estimate_;
  Camera adjusted_to_;  // The camera that the map's keyframes were adjusted to.
  int num_finished_keyframes_ = 0;
  Block block_;
  bool prior_rejected_ = false;
};

}  // namespace corvo
