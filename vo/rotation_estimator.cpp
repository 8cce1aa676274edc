#include "vo/rotation_estimator.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <Eigen/Geometry>
#include <Eigen/SVD>

#include "vo/levenberg_marquardt.h"
#include "vo/median.h"

namespace corvo {
namespace {

Eigen::Vector3d UnitRay(const Eigen::Vector2d& ray) { return ray.homogeneous().normalized(); }

/// Rotation that minimises the weighted squared distance of unit rays (Kabsch).
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

/// A motion but for its length.
struct EpipolarMotion {
  SO3 second_from_first;
  Eigen::Vector3d baseline;  ///< The first camera in the second's frame, a unit vector.
};

/// Two unit vectors at right angles to a unit vector and to each other.
Eigen::Matrix<double, 3, 2> TangentBasis(const Eigen::Vector3d& unit) {
  const Eigen::Vector3d first = unit.unitOrthogonal();
  Eigen::Matrix<double, 3, 2> basis;
  basis << first, unit.cross(first);
  return basis;
}

/// R ← Exp(ω) R, b ← b + B τ, normalised, with a step of ω and τ.
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

/// Least robust Sampson error near a rotation, known to `rotation_sigma`, and a direction of the
/// baseline.
Minimum<EpipolarMotion> FitEpipolar(const std::vector<RayMatch>& matches, const SO3& expected,
                                    double rotation_sigma, const Eigen::Vector3d& direction) {
  constexpr int kMaxIterations = 20;
  const auto build = [&](const EpipolarMotion& motion) {
    NormalEquations<5> equations;
    const Eigen::Matrix<double, 3, 2> basis = TangentBasis(motion.baseline);
    for (const RayMatch& match : matches) Accumulate(match, motion, basis, equations);
    const Eigen::Vector3d apart = (motion.second_from_first * expected.Inverse()).Log();
    const double information = 1 / (rotation_sigma * rotation_sigma);
    equations.cost += information * apart.squaredNorm();
    equations.hessian.topLeftCorner<3, 3>().diagonal().array() += information;
    equations.gradient.head<3>() += information * apart;
    return equations;
  };
  return MinimizeLevenbergMarquardt<5>(EpipolarMotion{expected, direction}, build, Plus,
                                       kMaxIterations);
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

SO3 RefineRotation(const std::vector<RayMatch>& matches, const SO3& second_from_first) {
  constexpr double kCommonParallax = 4;
  const double sigma =
      std::max(kCommonParallax * Median(ComputeParallax(matches, second_from_first)), 1e-9);
  Minimum<EpipolarMotion> best{{second_from_first, {}}, std::numeric_limits<double>::infinity()};
  for (int axis = 0; axis < 3; ++axis) {
    const Minimum<EpipolarMotion> fit =
        FitEpipolar(matches, second_from_first, sigma, Eigen::Vector3d::Unit(axis));
    if (fit.cost < best.cost) best = fit;
  }
  return best.state.second_from_first;
}

}  // namespace corvo
