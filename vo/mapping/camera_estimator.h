// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <utility>

#include "vo/camera/camera_information.h"
#include "vo/camera/camera_prior.h"
#include "vo/core/adjustment_status.h"
#include "vo/core/options.h"
#include "vo/mapping/camera_blocks.h"
#include "vo/optimization/bundle.h"

namespace corvo {

/// The keyframes that were adjusted to a new estimate of the camera.
struct CalibratedBundle {
  AdjustmentStatus status = AdjustmentStatus::kNone;
  Bundle bundle;
  CameraInformation of_block;
  CameraEstimate estimate;  ///< From all blocks; that of before unless the status is usable.
};

/// An estimate of the camera from a block of keyframes and the blocks before it. It does not refer
/// to the map.
class CameraEstimator {
 public:
  /// `before` is the estimate so far; `block` has no fixed views.
  CameraEstimator(const CameraPrior& prior, const CameraEstimate& before,
                  const CalibrationOptions& options, const CameraBlocks& finished, Bundle block);

  /// Has these keyframes adjusted to the estimate, in place of the block. To be called if the
  /// estimate may differ from that of the block alone.
  void AdjustToCamera(Bundle newest) { newest_ = std::move(newest); }

  /// Adjusts the block together with the camera, without a gauge, and then, if there are any, the
  /// other keyframes to the estimate of all blocks.
  CalibratedBundle operator()() const;

 private:
  CameraPrior prior_;
  CameraEstimate before_;
  CalibrationOptions options_;
  CameraBlocks finished_;
  Bundle block_;
  std::optional<Bundle> newest_;
};

}  // namespace corvo
