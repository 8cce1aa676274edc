// SPDX-License-Identifier: MIT
#include "vo/mapping/camera_estimator.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "vo/camera/camera_displacement.h"
#include "vo/math/chi_square.h"
#include "vo/math/median.h"
#include "vo/optimization/bundle_adjuster.h"
#include "vo/optimization/camera_covariance.h"
#include "vo/optimization/camera_move.h"
#include "vo/optimization/point_selection.h"

namespace corvo {
namespace {

/// Returns the options for adjusting the free views of a bundle.
AdjustmentOptions AdjustmentOf(const Bundle& bundle, const CalibrationOptions& options) {
  const auto num_free =
      std::ranges::count_if(bundle.views, [](const Bundle::View& view) { return !view.is_fixed; });
  return CalibrationAdjustment(options, static_cast<int>(num_free));
}

/// Marks the observations within the 95% quantile as inliers, the others as outliers. If the errors
/// are larger than their standard deviations, as those of a wrong camera are, the quantile is that
/// of their median.
void MarkInliers(const Camera& camera, Bundle& bundle) {
  constexpr double kMedian = 1.386;  // Of chi-square with two degrees of freedom.
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  std::vector<double> errors;
  VisitErrors(camera, bundle, [&](Bundle::Observation& /*observation*/, double error) {
    errors.push_back(std::min(kInfinity, error));  // Those that are not a number, too.
  });
  const double largest = kChiSquare2Dof95 * std::max(1.0, Median(errors) / kMedian);
  for (std::size_t i = 0; i < errors.size(); ++i) {
    bundle.observations[i].is_inlier = errors[i] <= largest;
  }
}

}  // namespace

CameraEstimator::CameraEstimator(const CameraPrior& prior, const CameraEstimate& before,
                                 const CalibrationOptions& options, const CameraBlocks& finished,
                                 Bundle block, Bundle kept, const Camera& kept_camera)
    : prior_(prior),
      before_(before),
      options_(options),
      finished_(finished),
      block_(std::move(block)),
      kept_(std::move(kept)),
      kept_camera_(kept_camera) {}

CalibratedBundle CameraEstimator::operator()() const {
  CalibratedBundle result{AdjustmentStatus::kConverged, {}, {}, before_};
  result.of_block = InformationOf(block_, before_.difference);
  CameraEstimate estimate = EstimateWith(result.of_block);
  if (IsFar(estimate)) {
    result.status = EstimateFar(result.of_block);
    if (!IsUsable(result.status)) return result;
    estimate = EstimateWith(result.of_block);
  }
  const std::optional<Camera> camera = Camera::Make(prior_.Apply(estimate.difference));
  if (!camera) {
    result.status = AdjustmentStatus::kInvalidCamera;
  } else if (LargestDisplacement(kept_camera_, *camera) > options_.max_displacement_px) {
    result.bundle = kept_;
    result.status = AdjustKept(*camera, *result.bundle);
  }
  if (IsUsable(result.status)) result.estimate = estimate;
  return result;
}

AdjustmentStatus CameraEstimator::AdjustKept(const Camera& camera, Bundle& kept) const {
  const AdjustmentOptions adjustment = AdjustmentOf(kept, options_);
  // Few points of each of many keyframes would give worse poses than the windows gave.
  const bool has_few_points = 4 * adjustment.points_per_view < options_.points_per_keyframe;
  return has_few_points ? MoveToCamera(kept_camera_, camera, adjustment, kept)
                        : BundleAdjuster(adjustment).Adjust(camera, kept).status;
}

CameraEstimate CameraEstimator::EstimateWith(const CameraInformation& of_block) const {
  CameraBlocks all = finished_;
  all.Add(of_block);
  return all.Estimate();
}

bool CameraEstimator::IsFar(const CameraEstimate& estimate) const {
  constexpr double kTrustedShare = 0.005;  // Of the image width.
  const Camera before(prior_.Apply(before_.difference));
  const std::optional<Camera> camera = Camera::Make(prior_.Apply(estimate.difference));
  return !camera || LargestDisplacement(before, *camera) > kTrustedShare * before.width();
}

AdjustmentStatus CameraEstimator::EstimateFar(CameraInformation& of_block) const {
  std::vector<Bundle> bundles{block_};
  const AdjustmentSummary summary = BundleAdjuster(AdjustmentOf(block_, options_))
                                        .Adjust(prior_, prior_.Apply(before_.difference), bundles);
  if (!summary.is_usable()) return summary.status;
  const Eigen::VectorXd& difference = summary.estimate.difference;
  of_block.matrix = InformationOf(std::move(bundles.front()), difference).matrix;
  // At the least cost, the gradients of the observations and of the prior cancel out.
  of_block.vector = (of_block.matrix + PriorInformation(prior_)) * difference;
  return summary.status;
}

CameraInformation CameraEstimator::InformationOf(Bundle block,
                                                 const Eigen::VectorXd& difference) const {
  MarkInliers(Camera(prior_.Apply(difference)), block);
  const int num_views = static_cast<int>(block.views.size());
  const int points_per_view = CalibrationAdjustment(options_, num_views).points_per_view;
  std::vector<Bundle> bundles{std::move(block)};
  CameraInformation information = ObservedInformation(
      prior_, {bundles, {SelectPoints(bundles.front(), points_per_view)}, difference});
  information.matrix *= options_.information_factor;
  information.vector *= options_.information_factor;
  return information;
}

}  // namespace corvo
