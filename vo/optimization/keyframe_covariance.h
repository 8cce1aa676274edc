// SPDX-License-Identifier: MIT
#pragma once

#include <unordered_map>
#include <vector>

#include <Eigen/Core>

#include "vo/camera/camera_prior.h"
#include "vo/core/conventions.h"
#include "vo/lie/se3.h"
#include "vo/optimization/bundle.h"

namespace corvo {

/// The joint uncertainty of the poses of some keyframes: of their errors ξ, where world_from_camera
/// = estimate * Exp(ξ), ξ = [υ ω]. An error δ of the free parameters of the camera moves poses and
/// landmarks:
///
///     ξ = G δ + n,   n ~ N(0, Σ)
///
/// There are 6 rows for each keyframe. Keyframes that are not contained are taken as exact.
struct KeyframeCovariance {
  std::vector<KeyframeId> keyframes;  ///< In ascending order.
  Eigen::MatrixXd matrix;             ///< Σ, for independent observations with sigma_px.
  Eigen::MatrixXd by_camera;          ///< G
  /// The derivatives of the positions of landmarks with respect to the camera.
  std::unordered_map<LandmarkId, Eigen::Matrix3Xd> landmarks_by_camera;

  int size() const { return static_cast<int>(keyframes.size()); }
  /// Returns the position of a keyframe in the list, or kNoId if it is not contained.
  int Find(KeyframeId keyframe) const;
  /// Returns the covariance of two keyframes, given their positions.
  SE3::Matrix6 Block(int row, int column) const { return matrix.block<6, 6>(6 * row, 6 * column); }
  /// Returns the rows of `by_camera` of a keyframe, given its position.
  Eigen::Matrix<double, 6, Eigen::Dynamic> ByCamera(int position) const;
};

/// Returns the covariance of the keyframes of an adjusted bundle: the inverse of the normal
/// equations of the inlier observations of the joint points, with the points and the frames that
/// are not keyframes marginalized. The gauge is that of
/// BundleAdjuster::Adjust: fixed views are exact, and a bundle without two of them is relative to
/// its oldest view and in units of the distance of the farthest one. `camera` has the parameters
/// whose errors are taken into account as its free ones; it is the given one of that prior.
KeyframeCovariance CovarianceOfViews(const CameraPrior& camera, const Bundle& bundle,
                                     const std::vector<char>& is_joint);

}  // namespace corvo
