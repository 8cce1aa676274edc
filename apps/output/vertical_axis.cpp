// SPDX-License-Identifier: MIT
#include "apps/output/vertical_axis.h"

#include <algorithm>

#include <Eigen/Core>

namespace corvo {

VerticalAxis AxesWithUp(int up, double sign) {
  const int next = (up + 1) % 3, after_next = (up + 2) % 3;
  // across x along = sign * up, so that the viewer looks down.
  return sign > 0 ? VerticalAxis{up, sign, next, after_next}
                  : VerticalAxis{up, sign, after_next, next};
}

VerticalAxis FindVerticalAxis(const PoseSequence& poses) {
  Eigen::Vector3d down = Eigen::Vector3d::Zero();
  for (const TimedPose& pose : poses) {
    down += pose.world_from_camera.rotation() * Eigen::Vector3d::UnitY();
  }
  if (poses.empty()) down = Eigen::Vector3d::UnitY();
  int up = 0;
  down.cwiseAbs().maxCoeff(&up);
  return AxesWithUp(up, down[up] > 0 ? -1 : 1);
}

bool HasRotations(const PoseSequence& poses) {
  constexpr double kLeastAngle_rad = 1e-6;
  return std::ranges::any_of(poses, [&](const TimedPose& pose) {
    const SO3& first = poses.front().world_from_camera.rotation();
    return (first.Inverse() * pose.world_from_camera.rotation()).Angle() > kLeastAngle_rad;
  });
}

}  // namespace corvo
