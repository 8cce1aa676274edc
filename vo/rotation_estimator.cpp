#include "vo/rotation_estimator.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <ceres/ceres.h>
#include <Eigen/Geometry>
#include <Eigen/SVD>

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

/// Signed Sampson distance of one match from the motion, in units of its sigma.
struct SampsonError {
  RayMatch match;

  template <typename T>
  bool operator()(const T* quaternion, const T* direction, T* residual) const {
    using Vector = Eigen::Matrix<T, 3, 1>;
    const Eigen::Map<const Eigen::Quaternion<T>> second_from_first(quaternion);
    const Eigen::Map<const Vector> baseline(direction);
    const Vector first = match.first.homogeneous().cast<T>();
    const Vector second = match.second.homogeneous().cast<T>();
    const Vector line_in_second = baseline.cross(second_from_first * first);
    const Vector line_in_first = second_from_first.conjugate() * second.cross(baseline);
    const T squared = line_in_second.template head<2>().squaredNorm() +
                      line_in_first.template head<2>().squaredNorm();
    constexpr double kNoBaseline = 1e-12;  // A ray along the baseline has no lines.
    residual[0] = second.dot(line_in_second) / (sqrt(squared + kNoBaseline) * match.sigma);
    return true;
  }
};

/// Angle between a rotation and an expected one, per axis, in units of its sigma.
struct RotationPrior {
  Eigen::Quaterniond expected;
  double sigma;

  template <typename T>
  bool operator()(const T* quaternion, T* residual) const {
    const Eigen::Map<const Eigen::Quaternion<T>> rotation(quaternion);
    const Eigen::Quaternion<T> apart = rotation * expected.conjugate().cast<T>();
    Eigen::Map<Eigen::Matrix<T, 3, 1>>{residual} = 2.0 / sigma * apart.w() * apart.vec();
    return true;
  }
};

struct EpipolarFit {
  SO3 second_from_first;
  double cost = std::numeric_limits<double>::infinity();
};

/// Least robust Sampson error near a rotation, known to `rotation_sigma`, and a direction of the
/// baseline.
EpipolarFit FitEpipolar(const std::vector<RayMatch>& matches, const SO3& initial_rotation,
                        double rotation_sigma, Eigen::Vector3d direction) {
  Eigen::Quaterniond rotation = initial_rotation.quaternion();
  ceres::Problem problem;
  problem.AddParameterBlock(rotation.coeffs().data(), 4, new ceres::EigenQuaternionManifold);
  problem.AddParameterBlock(direction.data(), 3, new ceres::SphereManifold<3>);
  for (const RayMatch& match : matches) {
    problem.AddResidualBlock(
        new ceres::AutoDiffCostFunction<SampsonError, 1, 4, 3>(new SampsonError{match}),
        new ceres::CauchyLoss(1), rotation.coeffs().data(), direction.data());
  }
  const RotationPrior prior{initial_rotation.quaternion(), rotation_sigma};
  problem.AddResidualBlock(
      new ceres::AutoDiffCostFunction<RotationPrior, 3, 4>(new RotationPrior(prior)), nullptr,
      rotation.coeffs().data());
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = 20;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) return {};
  return {SO3(rotation), summary.final_cost};
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
  EpipolarFit best{second_from_first};
  for (int axis = 0; axis < 3; ++axis) {
    const EpipolarFit fit =
        FitEpipolar(matches, second_from_first, sigma, Eigen::Vector3d::Unit(axis));
    if (fit.cost < best.cost) best = fit;
  }
  return best.second_from_first;
}

}  // namespace corvo
