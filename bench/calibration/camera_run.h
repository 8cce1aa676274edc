// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include <nlohmann/json.hpp>

#include "bench/odometry/recording.h"
#include "vo/camera/camera_prior.h"
#include "vo/odometry.h"

namespace corvo {

void to_json(nlohmann::json& json, const CameraEstimate& estimate);
void from_json(const nlohmann::json& json, CameraEstimate& estimate);

}  // namespace corvo

namespace corvo::bench {

/// What odometry made of a recording, and of the camera that it was given.
struct CameraRun {
  double ate = 0;  ///< Root mean square after one Sim3, in the truth's unit; NaN: cannot be said.
  double posed_share = 0;  ///< Of the frames, 0 to 1.
  int segments = 0;
  bool prior_rejected = false;
  CameraEstimate estimate;  ///< Of the difference from the given camera, at the end.
  double refined_ate = 0;   ///< After refinement; without one, and where it fails, as before.
  CameraEstimate refined_estimate;  ///< Likewise.
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CameraRun, ate, posed_share, segments, prior_rejected, estimate,
                                   refined_ate, refined_estimate)

/// The camera is estimated if anything of it is free. `after_frame` is called after each
/// frame.
CameraRun RunWithCamera(const Recording& recording, const CameraPrior& prior,
                        const OdometryOptions& options, bool refine = false,
                        const std::function<void(const Odometry&)>& after_frame = {});

/// Between a process and its child: NaN stays NaN.
template <typename Result>
std::string ToBytes(const Result& result) {
  std::string bytes;
  nlohmann::json::to_cbor(nlohmann::json(result), bytes);
  return bytes;
}

template <typename Result>
Result FromBytes(const std::string& bytes) {
  return nlohmann::json::from_cbor(bytes).get<Result>();
}

}  // namespace corvo::bench
