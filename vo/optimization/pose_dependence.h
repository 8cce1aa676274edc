// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <Eigen/Core>

#include "vo/camera/camera_prior.h"
#include "vo/core/conventions.h"
#include "vo/lie/se3.h"
#include "vo/map/frame.h"
#include "vo/map/map.h"
#include "vo/optimization/keyframe_covariance.h"

namespace corvo {

/// The sum of some squared errors, each in units of its variance, and their number.
struct SquaredErrors {
  double sum = 0;
  int count = 0;
};

/// How the error ξ of a located pose depends on the errors ξₖ of the poses of keyframes whose
/// landmarks it was located with, on the error δ of the camera, and on the noise of the images:
///
///     ξ = Σ Aₖ ξₖ + g δ + n,   n ~ N(0, N)
///
/// where ξₖ is the part of the keyframe's error that is not due to the camera.
struct PoseDependence {
  std::vector<KeyframeId> keyframes;                   ///< Those of the joint covariance.
  std::vector<SE3::Matrix6> gains;                     ///< Aₖ of each of them.
  Eigen::Matrix<double, 6, Eigen::Dynamic> by_camera;  ///< g
  SE3::Matrix6 noise = SE3::Matrix6::Zero();  ///< N, for independent keypoints with sigma_px.
  /// The errors of both axes of the keypoints that are aligned with their landmarks' patches, and
  /// of the others, in units of S.
  SquaredErrors aligned, detected;
  double distance = 0;        ///< Median distance of the landmarks.
  double distance_sigma = 0;  ///< Median of its standard deviation, relative to the distance.
};

/// Linearizes the pose of a frame in the landmarks that its keypoints observe. With the derivatives
/// J of a pixel by the pose and K by its landmark, the landmark's covariance C = (Σ Iₖ)⁻¹, see
/// LandmarkCovariance, and S = sigma_px² I + K C Kᵀ, the pose of OptimizePose has
///
///     N = H⁻¹ = (Σ Jᵀ S⁻¹ J)⁻¹,   Aₖ = -H⁻¹ Σ Jᵀ S⁻¹ K C Iₖ Rₖ [I, -hat(x_in_k)]
///
/// since a landmark moves with its keyframes, x = C Σ Iₖ xₖ. With the derivatives D of a pixel and
/// x' of a landmark by the camera, over the landmarks of which x' is known,
///
///     g = -(Σ Jᵀ S⁻¹ J)⁻¹ Σ Jᵀ S⁻¹ (D + K x')
///
/// `camera` has the parameters whose errors are taken into account as its free ones.
PoseDependence LinearizePose(const Map& map, const Frame& frame, const KeyframeCovariance& joint,
                             const CameraPrior& camera);

}  // namespace corvo
