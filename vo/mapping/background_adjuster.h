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

/// Adjusts a map on threads of its own, beside the frames that follow: the window of each new
/// keyframe and, whenever the number of keyframes has grown by a factor, the newest keyframes and
/// the camera with them. One of each at a time. Their results are used at fixed frames, however
/// long they took, so that the same frames find the same map.
class BackgroundAdjuster {
 public:
  /// Throws corvo::Error on a prior that is not valid.
  BackgroundAdjuster(const CameraPrior& prior, const OdometryOptions& options);

  /// Starts to adjust around the newest keyframe, after a frame, if that has not been started and
  /// the result of the previous adjustment has been used.
  void Start(int frame, const Map& map);

  /// Starts an estimate of the camera after the last frame, if there are keyframes that none has
  /// used. The result of the previous one has been used.
  void StartLastCalibration(int frame, const Map& map);

  /// Gives the map the results that are due before a frame, waiting for them: poses, points and the
  /// camera.
  UsedAdjustments UseResults(int frame, Map& map);

  const CameraEstimate& camera_estimate() const { return estimate_; }
  const CameraPrior& camera_prior() const { return prior_; }
  /// The images do not fit the given camera within its sigmas: it is used as it was given.
  bool prior_rejected() const { return prior_rejected_; }

 private:
  struct Result {
    Bundle bundle;
    AdjustmentSummary summary;
  };
  /// Under way while the result is valid.
  struct Job {
    std::future<Result> result;
    int due_frame = 0;

    bool IsRunning() const { return result.valid(); }
    bool IsDue(int frame) const { return IsRunning() && frame >= due_frame; }
  };

  /// Keyframes of a segment at which the camera is estimated next.
  int NextCalibration() const;
  void StartWindow(int frame, const Map& map);
  void StartCalibration(int frame, const Map& map);
  AdjustmentStatus UseWindow(Map& map);
  AdjustmentStatus UseCalibration(Map& map);

  CameraPrior prior_;
  OdometryOptions options_;
  Job window_;
  Job calibration_;
  KeyframeId newest_ = kNoId;  // Whose window was adjusted last, with the camera as it is now.
  CameraEstimate estimate_;
  int num_calibrated_ = 0;                // Keyframes in the newest estimate.
  KeyframeId newest_calibrated_ = kNoId;  // The newest of these.
  bool prior_rejected_ = false;
};

}  // namespace corvo
