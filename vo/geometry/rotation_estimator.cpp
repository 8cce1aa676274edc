// SPDX-License-Identifier: MIT
#include "vo/geometry/rotation_estimator.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include "vo/geometry/epipolar_motion.h"
#include "vo/math/median.h"

namespace corvo {
namespace {

Eigen::Vector3d UnitRay(const Eigen::Vector2d& ray) { return ray.homogeneous().normalized(); }

/// Returns the rotation that minimizes the weighted squared distances of unit rays (Kabsch).
SO3 AlignRays(const std::vector<RayMatch>& matches, const std::vector<double>& weights) {
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < matches.size(); ++i) {
    covariance += weights[i] * UnitRay(matches[i].second) * UnitRay(matches[i].first).transpose();
  }
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(covariance,
                                              Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d signs(1, 1, (svd.matrixU() * svd.matrixV().transpose()).determinant());
  return SO3(Eigen::Matrix3d(svd.matrixU() * signs.asDiagonal() * svd.matrixV().transpose()));
}

}  // namespace

SO3 EstimateRotation(const std::vector<RayMatch>& matches) {
  constexpr int kReweightings = 10;
  std::vector<double> weights(matches.size(), 1.0);
  SO3 rotation = AlignRays(matches, weights);
  for (int round = 0; round < kReweightings; ++round) {
    const std::vector<double> angles = ComputeParallax(matches, rotation);
    const double scale = std::max(Median(angles), 1e-9);
    for (std::size_t i = 0; i < matches.size(); ++i) {
      const double u = angles[i] / scale;
      weights[i] = 1 / ((1 + u * u) * (1 + u * u));
    }
    rotation = AlignRays(matches, weights);
  }
  return rotation;
}

std::vector<double> ComputeParallax(const std::vector<RayMatch>& matches,
                                    const SO3& second_from_first) {
  std::vector<double> angles;
  angles.reserve(matches.size());
  for (const RayMatch& match : matches) {
    const Eigen::Vector3d expected = second_from_first * UnitRay(match.first);
    const Eigen::Vector3d seen = UnitRay(match.second);
    angles.push_back(std::atan2(expected.cross(seen).norm(), expected.dot(seen)));
  }
  return angles;
}

SO3 RefineRotation(const std::vector<RayMatch>& matches, const SO3& second_from_first,
                   double common_parallax) {
  const double sigma =
      std::max(common_parallax * Median(ComputeParallax(matches, second_from_first)), 1e-9);
  const auto fits = FitEpipolarMotionsAlongAxes(matches, second_from_first, sigma);
  const auto best = std::ranges::min_element(fits, {}, &Minimum<EpipolarMotion>::cost);
  return best->state.second_from_first;
}

}  // namespace corvo
