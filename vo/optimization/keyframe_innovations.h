// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <Eigen/Core>

#include "vo/lie/se3.h"
#include "vo/optimization/keyframe_covariance.h"

namespace corvo {

/// The errors of some keyframes as the sum of independent parts, one that each keyframe adds to
/// those before it: its innovation. With the Cholesky factor of the joint covariance, Σ = L Lᵀ,
///
///     ξ = G δ + L w = L (L⁻¹ G δ + w),   w ~ N(0, I)
///
/// and the six numbers w_j of keyframe j move no keyframe before j. They move each later one, i, by
/// L_ij w_j; together, like a similarity once the landmarks of j are out of view. Its scale is the
/// ratio of the units of length before and after j. To first order in w_j, it has the logarithm
///
///     λ_j = s_j w_j,   s_j = Σ aᵢᵀ Rᵢ [I 0] L_ij / Σ aᵢᵀ aᵢ
///
/// over the keyframes i after j, with the arms aᵢ from the mean of their positions and their
/// rotations Rᵢ. The ratio of the units at keyframes a and b has the sum of λ_j over a < j ≤ b.
class KeyframeInnovations {
 public:
  using Matrix7X = Eigen::Matrix<double, 7, Eigen::Dynamic>;

  /// `world_from_keyframe` has the poses of the keyframes of the covariance.
  KeyframeInnovations(const KeyframeCovariance& covariance,
                      const std::vector<SE3>& world_from_keyframe);

  /// Whether enough keyframes follow that at a position to show which scale it hands on.
  bool KnowsScale(int position) const;

  /// Returns how the error [υ ω λ] of keyframe `second` relative to the earlier `first`, given
  /// their positions, depends on w. The error is that of first_from_second * Exp([υ ω]).
  Matrix7X ByInnovations(int first, int second) const;

  /// Returns how the same error depends on δ, given the matrix of ByInnovations().
  Matrix7X ByCamera(const Matrix7X& by_innovations) const { return by_innovations * whitened_; }

 private:
  /// Returns s_j of the keyframe at a position.
  Eigen::Matrix<double, 1, 6> FitScale(int position) const;

  std::vector<SE3> poses_;
  Eigen::MatrixXd factor_;       // L
  Eigen::MatrixXd whitened_;     // L⁻¹ G
  Eigen::RowVectorXd by_scale_;  // s_j of each keyframe; 0 where it is not known.
};

}  // namespace corvo
