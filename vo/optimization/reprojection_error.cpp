// SPDX-License-Identifier: MIT
#include "vo/optimization/reprojection_error.h"

#include <limits>
#include <optional>

namespace corvo {

double SquaredError(const Eigen::Vector3d& in_camera, const Observation& observation,
                    const Camera& camera) {
  const std::optional<Eigen::Vector2d> projected = camera.Project(in_camera);
  if (!projected) return std::numeric_limits<double>::infinity();
  return (*projected - observation.pixel).squaredNorm() /
         (observation.sigma_px * observation.sigma_px);
}

}  // namespace corvo
