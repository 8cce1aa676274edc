// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tests/support/random.h"

// Tangent vectors on which the laws of the Lie groups are tested.
namespace corvo::test {

inline constexpr double kPi = 3.14159265358979323846;
inline constexpr double kTinyDeg = 1e-12;

/// Returns rotation vectors at which formulas tend to break: zero, tiny, around the switch between
/// series and closed form, near π and π itself, along the axes and askew; and 100 random ones.
inline std::vector<Eigen::Vector3d> AwkwardRotations() {
  const std::vector<double> angles = {
      0,      1e-300, 1e-12,     1e-9, 1e-8, 1e-7,       1e-5,       1e-3,        0.2999, 0.3,
      0.3001, 1.0,    0.5 * kPi, 3.0,  3.14, kPi - 1e-5, kPi - 1e-8, kPi - 1e-12, kPi};
  std::vector<Eigen::Vector3d> axes = {Eigen::Vector3d::UnitX(), -Eigen::Vector3d::UnitY(),
                                       Eigen::Vector3d::UnitZ()};
  axes.push_back(Eigen::Vector3d(1, -2, 3).normalized());
  axes.push_back(Eigen::Vector3d(-1, 1e-9, 0).normalized());
  std::vector<Eigen::Vector3d> rotations;
  for (const Eigen::Vector3d& axis : axes) {
    for (const double angle : angles) rotations.push_back(angle * axis);
  }
  Random random(1);
  for (int i = 0; i < 100; ++i) rotations.push_back(random.Uniform(0, kPi) * random.Direction());
  return rotations;
}

/// Returns AwkwardRotations() with translations of length 0 to 1e6.
inline std::vector<SE3::Tangent> AwkwardMotions() {
  const double lengths[] = {0, 1e-9, 1, 100, 1e6};
  Random random(2);
  std::vector<SE3::Tangent> motions;
  for (const Eigen::Vector3d& omega : AwkwardRotations()) {
    SE3::Tangent motion;
    motion << lengths[motions.size() % 5] * random.Direction(), omega;
    motions.push_back(motion);
  }
  return motions;
}

}  // namespace corvo::test
