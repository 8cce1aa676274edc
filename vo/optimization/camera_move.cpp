// SPDX-License-Identifier: MIT
#include "vo/optimization/camera_move.h"

#include <cstddef>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "vo/math/chi_square.h"

namespace corvo {

AdjustmentStatus MoveToCamera(const Camera& before, const Camera& after, AdjustmentOptions options,
                              Bundle& bundle) {
  // Predicted observations have no outliers.
  options.huber_sigmas = 1e6;
  options.max_initial_error_sigmas = std::numeric_limits<double>::infinity();
  Bundle moved = bundle;
  const std::vector<std::optional<Eigen::Vector2d>> predicted = PredictPixels(before, bundle);
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    if (predicted[i]) moved.observations[i].pixel = *predicted[i];
  }
  const AdjustmentStatus status = BundleAdjuster(options).Adjust(after, moved).status;
  if (!IsUsable(status)) return status;
  bundle.views = std::move(moved.views);
  bundle.points = std::move(moved.points);
  VisitErrors(after, bundle, [](Bundle::Observation& observation, double error) {
    observation.is_inlier = error <= kChiSquare2Dof95;
  });
  return status;
}

}  // namespace corvo
