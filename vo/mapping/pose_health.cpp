// SPDX-License-Identifier: MIT
#include "vo/mapping/pose_health.h"

#include <algorithm>
#include <bitset>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace corvo {

double ImageCoverage(const Frame& frame, const Camera& camera) {
  constexpr int kColumns = 8, kRows = 6;
  std::bitset<kColumns * kRows> is_covered;
  for (int k = 0; k < frame.num_keypoints(); ++k) {
    if (frame.landmarks[k] == kNoId) continue;
    const int column = static_cast<int>(frame.pixel(k).x() / camera.width() * kColumns);
    const int row = static_cast<int>(frame.pixel(k).y() / camera.height() * kRows);
    is_covered.set(std::clamp(row, 0, kRows - 1) * kColumns + std::clamp(column, 0, kColumns - 1));
  }
  return static_cast<double>(is_covered.count()) / is_covered.size();
}

PoseHealth AssessPose(const Frame& frame, const Camera& camera, const PoseDependence& dependence,
                      double factor, const SE3::Matrix6& covariance) {
  PoseHealth health;
  health.image_coverage = ImageCoverage(frame, camera);
  health.distance_sigma = std::sqrt(factor) * dependence.distance_sigma;
  if (!(dependence.distance > 0) || !covariance.allFinite()) return health;
  const SE3::Matrix6 in_distances = ScaleCovariance(1 / dependence.distance, covariance);
  const Eigen::SelfAdjointEigenSolver<SE3::Matrix6> solver(in_distances, Eigen::EigenvaluesOnly);
  health.weakest_sigma = std::sqrt(std::max(0.0, solver.eigenvalues().maxCoeff()));
  return health;
}

}  // namespace corvo
