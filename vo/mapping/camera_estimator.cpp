// SPDX-License-Identifier: MIT
#include "vo/mapping/camera_estimator.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "vo/optimization/bundle_adjuster.h"

namespace corvo {
namespace {

/// Returns an adjuster of the free views of a bundle to a camera.
BundleAdjuster AdjusterOf(const Bundle& bundle, const CalibrationOptions& options) {
  const auto num_free =
      std::ranges::count_if(bundle.views, [](const Bundle::View& view) { return !view.is_fixed; });
  return BundleAdjuster(CalibrationAdjustment(options, static_cast<int>(num_free)));
}

}  // namespace

CameraEstimator::CameraEstimator(const CameraPrior& prior, const CameraEstimate& before,
                                 const CalibrationOptions& options, const CameraBlocks& finished,
                                 Bundle block)
    : prior_(prior),
      before_(before),
      options_(options),
      finished_(finished),
      block_(std::move(block)) {}

CalibratedBundle CameraEstimator::operator()() const {
  std::vector<Bundle> bundles{block_};
  const AdjustmentSummary of_block =
      AdjusterOf(block_, options_).Adjust(prior_, prior_.Apply(before_.difference), bundles);
  CalibratedBundle result{of_block.status, bundles.front(), of_block.information, before_};
  if (!of_block.is_usable()) return result;
  CameraBlocks all = finished_;
  all.Add(of_block.information);
  const CameraEstimate estimate = all.Estimate();
  if (newest_) {
    const std::optional<Camera> camera = Camera::Make(prior_.Apply(estimate.difference));
    result.status = AdjustmentStatus::kInvalidCamera;
    if (!camera) return result;
    result.bundle = *newest_;
    result.status = AdjusterOf(*newest_, options_).Adjust(*camera, result.bundle).status;
  }
  if (IsUsable(result.status)) result.estimate = estimate;
  return result;
}

}  // namespace corvo
