#pragma once

#include <future>
#include <optional>

#include "vo/camera/camera_prior.h"
#include "vo/core/conventions.h"
#include "vo/core/options.h"
#include "vo/map/map.h"
#include "vo/optimization/bundle.h"

namespace corvo {

/// Adjusts the map on threads of its own, beside the frames that follow: the window of a new
/// keyframe and, whenever the map has grown by a third, more keyframes and the camera with them; by
/// as much again, where the images contradict the camera. One of each at a time. Their results
/// are due at fixed frames, however long they took, so that the same frames find the same map.
class MapAdjuster {
 public:
  /// Throws corvo::Error on a prior that is not valid.
  MapAdjuster(const CameraPrior& prior, const OdometryOptions& options);

  /// Begins to adjust around the newest keyframe, after a frame, if that has not been begun and the
  /// result of the adjustment before has been taken.
  void Start(const Map& map, int frame);

  /// Begins an estimate of the camera after the last frame, if there are keyframes that told none.
  /// What was begun before has been taken.
  void StartLastCalibration(const Map& map, int frame);

  /// Gives the map the results that are due before a frame, waiting for them: poses, points and the
  /// camera. Returns whether there were any.
  bool Finish(int frame, Map& map);

  const CameraEstimate& camera_estimate() const { return estimate_; }
  const CameraPrior& camera_prior() const { return prior_; }
  /// The images do not fit the given camera within its sigmas: it is used as it was given.
  bool prior_rejected() const { return prior_rejected_; }

 private:
  struct Calibrated {
    Bundle bundle;
    std::optional<CameraEstimate> estimate;  // None: the solver failed, and nothing changes.
  };

  /// Under way while the result is valid.
  template <typename Result>
  struct Adjustment {
    std::future<Result> result;
    int due_frame = 0;

    bool IsDue(int frame) const { return result.valid() && frame >= due_frame; }
  };

  /// Keyframes of a segment at which the camera is estimated next.
  int NextCalibration() const;
  void StartCalibration(const Map& map, int frame);
  void FinishCalibration(Map& map);

  CameraPrior prior_;
  OdometryOptions options_;
  Adjustment<Bundle> window_;
  Adjustment<Calibrated> calibration_;
  KeyframeId newest_ = kNoId;  // Whose window was adjusted last, with the camera as it is now.
  CameraEstimate estimate_;
  int num_calibrated_ = 0;                // Keyframes that told estimate_, or are about to.
  KeyframeId newest_calibrated_ = kNoId;  // Of these.
  bool prior_rejected_ = false;
};

}  // namespace corvo
