// SPDX-License-Identifier: MIT
#include "vo/camera/camera_displacement.h"

#include <algorithm>
#include <optional>

#include <Eigen/Geometry>

namespace corvo {
namespace {

/// Returns the pixel in `to` of the ray of a pixel in `from`.
std::optional<Eigen::Vector2d> Transfer(const Camera& from, const Camera& to,
                                        const Eigen::Vector2d& pixel) {
  const std::optional<Eigen::Vector2d> ray = from.Undistort(pixel);
  return ray ? to.Project(ray->homogeneous()) : std::nullopt;
}

}  // namespace

double LargestDisplacement(const Camera& from, const Camera& to) {
  constexpr int kSteps = 8;  // Along each axis of the image.
  double largest = 0;
  for (int row = 0; row <= kSteps; ++row) {
    for (int column = 0; column <= kSteps; ++column) {
      const Eigen::Vector2d pixel((from.width() - 1.0) * column / kSteps,
                                  (from.height() - 1.0) * row / kSteps);
      const std::optional<Eigen::Vector2d> moved = Transfer(from, to, pixel);
      if (moved) largest = std::max(largest, (*moved - pixel).norm());
    }
  }
  return largest;
}

}  // namespace corvo
