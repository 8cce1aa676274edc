// SPDX-License-Identifier: MIT
#pragma once

#include <future>

#include "vo/camera/camera_prior.h"
#include "vo/core/adjustment_status.h"
#include "vo/core/conventions.h"
#include "vo/core/options.h"
#include "vo/map/map.h"
#include "vo/optimization/bundle_adjuster.h"

namespace corvo {

/// Adjusts a map on threads of its own, in parallel to the following frames: the window of each new
/// keyframe and, whenever the number of keyframes has grown by a factor, the newest keyframes
/// together with the camera. At most one adjustment of each kind runs at a time. Results are
/// applied at fixed frames, however long they took, so that the map does not depend on timing.
class BackgroundAdjuster {
 public:
  /// Throws corvo::Error if the prior is invalid.
  BackgroundAdjuster(const CameraPrior& prior, const OdometryOptions& options);

  /// Starts an adjustment around the newest keyframe after `frame`, unless that has been started
  /// already or the result of the previous adjustment has not been applied.
  void Start(int frame, const Map& map);

  /// Starts an estimate of the camera after the last frame, if there are keyframes that no estimate
  /// has used. The result of the previous one must have been applied.
  void StartLastCalibration(int frame, const Map& map);

  /// Waits for the results that are due before `frame` and applies them to the map: poses, points
  /// and the camera.
  UsedAdjustments UseResults(int frame, Map& map);

  const CameraEstimate& camera_estimate() const { return estimate_; }
  const CameraPrior& camera_prior() const { return prior_; }
  /// Returns whether the images contradict the given camera beyond its sigmas; it is then used as
  /// given.
  bool prior_rejected() const { return prior_rejected_; }

 private:
  struct Result {
    Bundle bundle;
    AdjustmentSummary summary;
  };
  /// An adjustment, in progress while `result` is valid.
  struct Job {
    std::future<Result> result;
    int due_frame = 0;

    bool IsRunning() const { return result.valid(); }
    bool IsDue(int frame) const { return IsRunning() && frame >= due_frame; }
  };

  /// Returns the number of keyframes of a segment at which the camera is estimated next.
  int NextCalibration() const;
  void StartWindow(int frame, const Map& map);
  void StartCalibration(int frame, const Map& map);
  AdjustmentStatus UseWindow(Map& map);
  AdjustmentStatus UseCalibration(Map& map);

  CameraPrior prior_;
  OdometryOptions options_;
  Job window_;
  Job calibration_;
  KeyframeId newest_ = kNoId;  // Keyframe whose window was adjusted last with the current camera.
  CameraEstimate estimate_;
  int num_calibrated_ = 0;                // Number of keyframes in the newest estimate.
  KeyframeId newest_calibrated_ = kNoId;  // Newest keyframe in that estimate.
  bool prior_rejected_ = false;
};

}  // namespace corvo
