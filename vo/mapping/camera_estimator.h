// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include <optional>

#include "vo/camera/camera.h"
#include "vo/camera/camera_information.h"
#include "vo/camera/camera_prior.h"
#include "vo/core/adjustment_status.h"
#include "vo/core/options.h"
#include "vo/mapping/camera_blocks.h"
#include "vo/optimization/bundle.h"

namespace corvo {

/// A new estimate of the camera, and the keyframes that were adjusted to it.
struct CalibratedBundle {
  AdjustmentStatus status = AdjustmentStatus::kNone;
  /// Unset if the estimate is so near to the camera of before that nothing had to be adjusted.
  std::optional<Bundle> bundle;
  CameraInformation of_block;
  CameraEstimate estimate;  ///< From all blocks; that of before unless the status is usable.
};

/// An estimate of the camera from a block of keyframes and the blocks before it. Without a gauge,
/// the block's inliers are linearized at the map, which makes the estimate a step of the
/// Gauss-Newton method; if the step is too long for that, at the minimum of the block's error. It
/// does not refer to the map.
class CameraEstimator {
 public:
  /// `before` is the estimate so far; `block` has no fixed views; `kept` has the keyframes that are
  /// to be adjusted to the estimate, and `kept_camera` the camera that they were adjusted to.
  CameraEstimator(const CameraPrior& prior, const CameraEstimate& before,
                  const CalibrationOptions& options, const CameraBlocks& finished, Bundle block,
                  Bundle kept, const Camera& kept_camera);

  CalibratedBundle operator()() const;

 private:
  /// Returns the estimate from all blocks.
  CameraEstimate EstimateWith(const CameraInformation& of_block) const;
  /// Returns whether an estimate is too far from the one before for a linearization there.
  bool IsFar(const CameraEstimate& estimate) const;
  /// Sets what the block tells of the camera, linearized at its minimum, if the status is usable.
  AdjustmentStatus EstimateFar(CameraInformation& of_block) const;
  /// Adjusts the kept keyframes to a new camera.
  AdjustmentStatus AdjustKept(const Camera& camera, Bundle& kept) const;
  /// Returns what a block tells of the camera, linearized at a difference from the given one.
  CameraInformation InformationOf(Bundle block, const Eigen::VectorXd& difference) const;

  CameraPrior prior_;
  CameraEstimate before_;
  CalibrationOptions options_;
  CameraBlocks finished_;
  Bundle block_;
  Bundle kept_;
  Camera kept_camera_;
};

}  // namespace corvo
