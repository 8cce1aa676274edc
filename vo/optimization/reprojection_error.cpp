#include "vo/optimization/reprojection_error.h"

#include <limits>
#include <optional>

namespace corvo {

double SquaredError(const PointObservation& observation, const SE3& camera_from_world,
                    const Camera& camera) {
  const std::optional<Eigen::Vector2d> projected =
      camera.Project(camera_from_world * observation.in_world);
  if (!projected) return std::numeric_limits<double>::infinity();
  return (*projected - observation.pixel).squaredNorm() /
         (observation.sigma_px * observation.sigma_px);
}

}  // namespace corvo
