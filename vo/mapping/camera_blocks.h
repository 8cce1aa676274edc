// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

#include "vo/camera/camera_information.h"
#include "vo/camera/camera_prior.h"

namespace corvo {

/// The estimate of a camera from blocks of keyframes that share no observation. With the prior's
/// information Λ₀ and the blocks' matrices Hᵢ and vectors ηᵢ, the difference d from the given
/// camera and its covariance C are
///
///     C = s (Λ₀ + q Σ Hᵢ)⁻¹,   d = (Λ₀ + Σ Hᵢ)⁻¹ Σ ηᵢ
///
/// where q is the share of the information that independent recordings confirm. Parameters that
/// need evidence have d = 0 unless the model in which they are free is more likely than the one in
/// which they are exact by a factor of e⁵ ("very strong": Kass and Raftery, Bayes factors, 1995);
/// their variances are those of C in any case. The likelihood of a model with its parameters
/// integrated out is proportional to
///
///     sqrt(|Λ₀| / |Λ₀ + q Σ Hᵢ|) exp(½ (q Σ ηᵢ)ᵀ (Λ₀ + q Σ Hᵢ)⁻¹ (q Σ ηᵢ))
///
/// Nothing counts twice and nothing is forgotten, also across segments and losses. If the blocks
/// agree, s = 1. They disagree if the χ² of their differences from d (with q Hᵢ), which has a
/// distribution with (n - 1) p degrees of freedom for n blocks and p parameters, is beyond
/// its 99.9% quantile: the lens was zoomed or focused, or the model lacks something. Then s = χ² /
/// ((n - 1) p).
class CameraBlocks {
 public:
  /// `stated_share` is q.
  CameraBlocks(const CameraPrior& prior, double stated_share)
      : prior_(prior), stated_share_(stated_share) {}

  void Add(CameraInformation block) { blocks_.push_back(std::move(block)); }

  int size() const { return static_cast<int>(blocks_.size()); }

  /// Returns the estimate of all blocks: the prior's without one.
  CameraEstimate Estimate() const;

 private:
  /// Returns the difference from the given camera, given the sum of all blocks.
  Eigen::VectorXd Difference(const CameraInformation& sum) const;
  /// Returns the logarithm of the likelihood of the model in which the parameters with the given
  /// indices are free, up to a constant.
  double LogLikelihood(const CameraInformation& sum, const std::vector<int>& free) const;
  /// Returns the χ² of the blocks' differences from `difference`.
  double ChiSquare(const Eigen::VectorXd& difference) const;

  CameraPrior prior_;
  double stated_share_;
  std::vector<CameraInformation> blocks_;
};

}  // namespace corvo
