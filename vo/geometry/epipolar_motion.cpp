// SPDX-License-Identifier: MIT
#include "vo/geometry/epipolar_motion.h"

#include <cmath>

#include <Eigen/Geometry>

namespace corvo {
namespace {

/// Returns two unit vectors orthogonal to a unit vector and to each other.
Eigen::Matrix<double, 3, 2> TangentBasis(const Eigen::Vector3d& unit) {
  const Eigen::Vector3d first = unit.unitOrthogonal();
  Eigen::Matrix<double, 3, 2> basis;
  basis << first, unit.cross(first);
  return basis;
}

/// Applies a step of ω and τ: R ← Exp(ω) R, b ← b + B τ, normalized.
EpipolarMotion Plus(const EpipolarMotion& motion, const Eigen::Matrix<double, 5, 1>& step) {
  return {SO3::Exp(step.head<3>()) * motion.second_from_first,
          (motion.baseline + TangentBasis(motion.baseline) * step.tail<2>()).normalized()};
}

/// The Sampson distance of a match and its derivative with respect to a step: (s · (b × Rf)) / n in
/// units of the sigma of the match, where n² is the sum of the squared norms of the normals of its
/// two epipolar lines.
struct SampsonDistance {
  double value;
  Eigen::Matrix<double, 5, 1> by_step;
};

SampsonDistance ComputeDistance(const RayMatch& match, const EpipolarMotion& motion,
                                const Eigen::Matrix<double, 3, 2>& basis) {
  constexpr double kNoBaseline = 1e-12;  // A ray along the baseline has no epipolar line.
  const SO3& rotation = motion.second_from_first;
  const Eigen::Vector3d& baseline = motion.baseline;
  const Eigen::Vector3d first = rotation * match.first.homogeneous();
  const Eigen::Vector3d second = match.second.homogeneous();
  const Eigen::Vector3d plane = second.cross(baseline);
  Eigen::Vector3d in_second = baseline.cross(first);
  Eigen::Vector3d in_first = rotation.Inverse() * plane;
  const double product = second.dot(in_second);
  in_second.z() = 0;
  in_first.z() = 0;
  const double norm = std::sqrt(in_second.squaredNorm() + in_first.squaredNorm() + kNoBaseline);
  const Eigen::Vector3d turned = rotation * in_first;
  const Eigen::Vector3d norm_by_rotation =
      (first.cross(in_second.cross(baseline)) + turned.cross(plane)) / norm;
  const Eigen::Vector3d norm_by_baseline = (first.cross(in_second) + turned.cross(second)) / norm;
  const double ratio = product / norm;
  SampsonDistance distance{product / (norm * match.sigma), {}};
  distance.by_step << first.cross(plane) - ratio * norm_by_rotation,
      basis.transpose() * (first.cross(second) - ratio * norm_by_baseline);
  distance.by_step /= norm * match.sigma;
  return distance;
}

/// Adds a distance e under Cauchy's loss log(1 + e²).
void Accumulate(const SampsonDistance& distance, NormalEquations<5>& equations) {
  const double squared = distance.value * distance.value;
  const double weight = 1 / (1 + squared);
  equations.cost += std::log1p(squared);
  equations.hessian += weight * distance.by_step * distance.by_step.transpose();
  equations.gradient += weight * distance.value * distance.by_step;
}

}  // namespace

Minimum<EpipolarMotion> FitEpipolarMotion(const std::vector<RayMatch>& matches,
                                          const EpipolarMotion& start, double rotation_sigma) {
  constexpr int kMaxIterations = 20;
  const SO3 from_expected = start.second_from_first.Inverse();
  const double information = 1 / (rotation_sigma * rotation_sigma);
  const auto build = [&](const EpipolarMotion& motion) {
    NormalEquations<5> equations;
    const Eigen::Matrix<double, 3, 2> basis = TangentBasis(motion.baseline);
    for (const RayMatch& match : matches) {
      Accumulate(ComputeDistance(match, motion, basis), equations);
    }
    const Eigen::Vector3d apart = (motion.second_from_first * from_expected).Log();
    equations.cost += information * apart.squaredNorm();
    equations.hessian.topLeftCorner<3, 3>().diagonal().array() += information;
    equations.gradient.head<3>() += information * apart;
    return equations;
  };
  return MinimizeLevenbergMarquardt<5>(start, build, Plus, kMaxIterations);
}

std::vector<Minimum<EpipolarMotion>> FitEpipolarMotionsAlongAxes(
    const std::vector<RayMatch>& matches, const SO3& second_from_first, double rotation_sigma) {
  std::vector<Minimum<EpipolarMotion>> fits;
  for (int axis = 0; axis < 3; ++axis) {
    const EpipolarMotion start{second_from_first, Eigen::Vector3d::Unit(axis)};
    fits.push_back(FitEpipolarMotion(matches, start, rotation_sigma));
  }
  return fits;
}

}  // namespace corvo
