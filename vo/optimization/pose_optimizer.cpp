#include "vo/optimization/pose_optimizer.h"

#include <limits>

#include <Eigen/LU>

#include "vo/lie/so3.h"
#include "vo/math/chi_square.h"
#include "vo/math/huber.h"
#include "vo/math/levenberg_marquardt.h"

namespace corvo {
namespace {

/// Huber's while it is robust, otherwise the squared error itself.
Loss EvaluateLoss(double squared_error, bool robust) {
  return robust ? HuberLoss(squared_error, kChiSquare2Dof95) : Loss{squared_error, 1.0};
}

/// An observation with the inverse of its residual's covariance.
struct WeightedObservation {
  Eigen::Vector3d in_world;
  Eigen::Vector2d pixel;
  Eigen::Matrix2d information;
};

WeightedObservation Weigh(const PointObservation& observation, const SE3& camera_from_world,
                          const Camera& camera) {
  Eigen::Matrix2d covariance =
      observation.sigma_px * observation.sigma_px * Eigen::Matrix2d::Identity();
  Camera::Jacobian pixel_by_point;
  if (camera.Project(camera_from_world * observation.in_world, &pixel_by_point)) {
    const Camera::Jacobian jacobian = pixel_by_point * camera_from_world.rotation().matrix();
    covariance += jacobian * observation.covariance * jacobian.transpose();
  }
  return {observation.in_world, observation.pixel, covariance.inverse()};
}

/// Adds one observation. With X = T⁻¹ X_w and T ← T Exp([υ ω]): dX = -υ + X × ω.
void Accumulate(const WeightedObservation& observation, const SE3& camera_from_world,
                const Camera& camera, bool robust, NormalEquations<6>& equations) {
  const Eigen::Vector3d in_camera = camera_from_world * observation.in_world;
  Camera::Jacobian pixel_by_point;
  const std::optional<Eigen::Vector2d> projected = camera.Project(in_camera, &pixel_by_point);
  if (!projected) {
    equations.cost += EvaluateLoss(1e6, robust).value;
    return;
  }
  const Eigen::Vector2d residual = *projected - observation.pixel;
  Eigen::Matrix<double, 2, 6> jacobian;
  jacobian.leftCols<3>() = -pixel_by_point;
  jacobian.rightCols<3>() = pixel_by_point * SO3::Hat(in_camera);
  const Loss loss = EvaluateLoss(residual.dot(observation.information * residual), robust);
  const Eigen::Matrix<double, 6, 2> weighted =
      loss.weight * jacobian.transpose() * observation.information;
  equations.cost += loss.value;
  equations.hessian += weighted * jacobian;
  equations.gradient += weighted * residual;
}

/// Over the observations in use.
SE3 Minimize(const SE3& pose, const std::vector<WeightedObservation>& observations,
             const std::vector<char>& use, const Camera& camera, bool robust) {
  constexpr int kMaxIterations = 10;
  const auto build = [&](const SE3& world_from_camera) {
    NormalEquations<6> equations;
    const SE3 camera_from_world = world_from_camera.Inverse();
    for (std::size_t i = 0; i < observations.size(); ++i) {
      if (use[i]) Accumulate(observations[i], camera_from_world, camera, robust, equations);
    }
    return equations;
  };
  const auto plus = [](const SE3& at, const Eigen::Matrix<double, 6, 1>& step) {
    return at * SE3::Exp(step);
  };
  return MinimizeLevenbergMarquardt<6>(pose, build, plus, kMaxIterations).state;
}

}  // namespace

double SquaredError(const PointObservation& observation, const SE3& camera_from_world,
                    const Camera& camera) {
  const std::optional<Eigen::Vector2d> projected =
      camera.Project(camera_from_world * observation.in_world);
  if (!projected) return std::numeric_limits<double>::infinity();
  return (*projected - observation.pixel).squaredNorm() /
         (observation.sigma_px * observation.sigma_px);
}

PoseEstimate OptimizePose(const SE3& initial, const std::vector<PointObservation>& observations,
                          const Camera& camera) {
  constexpr int kRounds = 4;
  constexpr int kRobustRounds = 2;
  PoseEstimate estimate;
  estimate.world_from_camera = initial;
  estimate.is_inlier.assign(observations.size(), 1);
  std::vector<WeightedObservation> weighted;
  const SE3 initial_from_world = initial.Inverse();
  for (const PointObservation& observation : observations) {
    weighted.push_back(Weigh(observation, initial_from_world, camera));
  }
  for (int round = 0; round < kRounds; ++round) {
    estimate.world_from_camera = Minimize(estimate.world_from_camera, weighted, estimate.is_inlier,
                                          camera, round < kRobustRounds);
    const SE3 camera_from_world = estimate.world_from_camera.Inverse();
    estimate.num_inliers = 0;
    for (std::size_t i = 0; i < observations.size(); ++i) {
      estimate.is_inlier[i] =
          SquaredError(observations[i], camera_from_world, camera) <= kChiSquare2Dof95;
      estimate.num_inliers += estimate.is_inlier[i];
    }
    if (estimate.num_inliers < 6) break;
  }
  return estimate;
}

}  // namespace corvo
