// SPDX-License-Identifier: MIT
#include "vo/optimization/camera_move.h"

#include <limits>
#include <utility>
#include <vector>

#include "vo/math/chi_square.h"

namespace corvo {
namespace {

/// Moves the observations of a bundle to where a camera sees their points.
void PredictObservations(const Camera& camera, Bundle& bundle) {
  const std::vector<SE3> camera_from_local = CamerasFromLocal(bundle);
  for (Bundle::Observation& observation : bundle.observations) {
    const Eigen::Vector3d& in_local = bundle.points[observation.point].in_local;
    const auto pixel = camera.Project(camera_from_local[observation.view] * in_local);
    if (pixel) observation.pixel = *pixel;
  }
}

}  // namespace

AdjustmentStatus MoveToCamera(const Camera& before, const Camera& after, AdjustmentOptions options,
                              Bundle& bundle) {
  // Predicted observations have no outliers.
  options.huber_sigmas = 1e6;
  options.max_initial_error_sigmas = std::numeric_limits<double>::infinity();
  Bundle moved = bundle;
  PredictObservations(before, moved);
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
