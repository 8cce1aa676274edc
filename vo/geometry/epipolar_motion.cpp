#include "vo/geometry/epipolar_motion.h"

#include <cmath>

#include <Eigen/Geometry>

namespace corvo {
namespace {

/// Two unit vectors at right angles to a unit vector and to each other.
Eigen::Matrix<double, 3, 2> TangentBasis(const Eigen::Vector3d& unit) {
  const Eigen::Vector3d first = unit.unitOrthogonal();
  Eigen::Matrix<double, 3, 2> basis;
  basis << first, unit.cross(first);
  return basis;
}

/// R ← Exp(ω) R, b ← b + B τ, normalized, with a step of ω and τ.
EpipolarMotion Plus(const EpipolarMotion& motion, const Eigen::Matrix<double, 5, 1>& step) {
  return {SO3::Exp(step.head<3>()) * motion.second_from_first,
          (motion.baseline + TangentBasis(motion.baseline) * step.tail<2>()).normalized()};
}

/// Adds the squared Sampson distance e² = (s · (b × Rf))² / n² of one match, n² the squared norms
/// of its two epipolar lines' normals, in units of its sigma, under Cauchy's loss log(1 + e²).
void Accumulate(const RayMatch& match, const EpipolarMotion& motion,
                const Eigen::Matrix<double, 3, 2>& basis, NormalEquations<5>& equations) {
  constexpr double kNoBaseline = 1e-12;  // A ray along the baseline has no lines.
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
  const double error = product / (norm * match.sigma);
  const Eigen::Vector3d turned = rotation * in_first;
  const Eigen::Vector3d product_by_rotation = first.cross(plane);
  const Eigen::Vector3d product_by_baseline = first.cross(second);
  const Eigen::Vector3d norm_by_rotation =
      (first.cross(in_second.cross(baseline)) + turned.cross(plane)) / norm;
  const Eigen::Vector3d norm_by_baseline = (first.cross(in_second) + turned.cross(second)) / norm;
  const double ratio = product / norm;
  Eigen::Matrix<double, 5, 1> by_step;
  by_step << product_by_rotation - ratio * norm_by_rotation,
      basis.transpose() * (product_by_baseline - ratio * norm_by_baseline);
  by_step /= norm * match.sigma;
  const double weight = 1 / (1 + error * error);
  equations.cost += std::log1p(error * error);
  equations.hessian += weight * by_step * by_step.transpose();
  equations.gradient += weight * error * by_step;
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
    for (const RayMatch& match : matches) Accumulate(match, motion, basis, equations);
    const Eigen::Vector3d apart = (motion.second_from_first * from_expected).Log();
    equations.cost += information * apart.squaredNorm();
    equations.hessian.topLeftCorner<3, 3>().diagonal().array() += information;
    equations.gradient.head<3>() += information * apart;
    return equations;
  };
  return MinimizeLevenbergMarquardt<5>(start, build, Plus, kMaxIterations);
}

}  // namespace corvo
