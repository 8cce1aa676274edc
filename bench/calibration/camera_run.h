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

/// The accuracy of odometry on a recording and its estimate of the camera.
struct CameraRun {
  double ate = 0;          ///< RMSE after one Sim3 alignment, ground truth's unit; NaN if unknown.
  double posed_share = 0;  ///< Share of frames with a pose, 0 to 1.
  int segments = 0;
  bool prior_rejected = false;
  CameraEstimate estimate;          ///< Final estimate of the difference from the given camera.
  double refined_ate = 0;           ///< ATE after refinement; `ate` if there is none or it fails.
  CameraEstimate refined_estimate;  ///< Estimate after refinement, else `estimate`.
};
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(CameraRun, ate, posed_share, segments, prior_rejected, estimate,
                                   refined_ate, refined_estimate)

/// Runs odometry on a recording. The camera is estimated if any of its parameters is free.
/// `after_frame` is called after each frame.
CameraRun RunWithCamera(const Recording& recording, const CameraPrior& prior,
                        const OdometryOptions& options, bool refine = false,
                        const std::function<void(const Odometry&)>& after_frame = {});

/// Serializes a result for the pipe between a process and its child. NaN stays NaN.
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
