// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <vector>

#include "vo/camera/camera_prior.h"
#include "vo/core/conventions.h"
#include "vo/core/frame_result.h"
#include "vo/core/options.h"
#include "vo/lie/se3.h"
#include "vo/map/frame.h"
#include "vo/map/map.h"
#include "vo/mapping/variance_factor.h"
#include "vo/optimization/keyframe_covariance.h"
#include "vo/optimization/pose_dependence.h"

namespace corvo {

/// The uncertainty of a pose relative to a keyframe: the covariance of the error ξ, where
/// keyframe_from_camera = estimate * Exp(ξ), ξ = [υ ω].
struct UncertaintyToKeyframe {
  KeyframeId keyframe = kNoId;
  SE3::Matrix6 covariance = SE3::Matrix6::Zero();
  PoseHealth health;  ///< Without `found_share`.
};

/// The uncertainty of the newest keyframes and of the frames that are located with their landmarks.
/// The joint covariance of the keyframes is that of the window that was adjusted last; keyframes
/// that were inserted since then are added to it by their PoseDependence (state augmentation).
class PoseUncertainty {
 public:
  /// `prior` has the free parameters of the camera.
  PoseUncertainty(const CameraPrior& prior, const BundleAdjusterOptions& options);

  /// Takes the covariance of a window that was adjusted.
  void UseWindow(KeyframeCovariance window);
  /// Computes the covariance of the window around a keyframe, as at the start of a segment.
  void ComputeWindow(const Map& map, KeyframeId keyframe);

  /// Adds a located frame that is about to be inserted as the next keyframe.
  void AddKeyframe(const Map& map, const Frame& frame);

  /// Returns the covariance of a located frame relative to the newest active keyframe of the joint
  /// covariance. That is computed anew, around the frame's landmarks, if it has none of their
  /// keyframes: the camera has returned to an earlier place. Returns std::nullopt if it is unknown.
  std::optional<UncertaintyToKeyframe> OfFrame(const Map& map, const Frame& frame,
                                               const CameraEstimate& camera);
  /// Returns the covariance of the newest keyframe, of this frame, relative to the one before it,
  /// or std::nullopt if it is unknown.
  std::optional<UncertaintyToKeyframe> OfNewestKeyframe(const Map& map, const Frame& frame,
                                                        const CameraEstimate& camera) const;
  /// Returns the covariance of a keyframe relative to another one. Those that the joint covariance
  /// does not contain are exact.
  SE3::Matrix6 Between(const Map& map, KeyframeId first, KeyframeId second,
                       const CameraEstimate& camera) const;

  /// Returns the joint covariance of the newest keyframes.
  const KeyframeCovariance& joint() const { return joint_; }
  /// Returns the factor from the covariance of the measurement model to the one that is stated: the
  /// measured variance of the newest frame, and the correlation of errors between frames.
  double factor() const { return factor_; }

 private:
  struct Added {
    KeyframeId keyframe;
    PoseDependence dependence;
  };
  /// Extends the joint covariance by a keyframe.
  void Append(const Added& added);
  /// Returns the camera of the map with the free parameters.
  CameraPrior CameraOf(const Map& map) const { return {map.camera().parameters(), free_}; }

  std::vector<FreeParameter> free_;
  BundleAdjusterOptions window_options_;
  KeyframeCovariance joint_;
  std::vector<Added> added_;  // Since the window, in ascending order.
  VarianceFactor variance_;
  double factor_ = 1;
};

/// Returns the newest active keyframe of the segment of `keyframe` that is older than it, or kNoId.
KeyframeId KeyframeBefore(const Map& map, KeyframeId keyframe);

}  // namespace corvo
