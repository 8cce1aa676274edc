// SPDX-License-Identifier: MIT
#include "vo/optimization/pose_optimizer.h"

#include <optional>

#include <Eigen/LU>

#include "vo/lie/so3.h"
#include "vo/math/chi_square.h"
#include "vo/math/huber.h"
#include "vo/math/levenberg_marquardt.h"
#include "vo/optimization/reprojection_error.h"

namespace corvo {
namespace {

/// An observation with the inverse of its residual's covariance.
struct WeightedObservation {
  Eigen::Vector3d in_world;
  Eigen::Vector2d pixel;
  Eigen::Matrix2d information;
};

WeightedObservation Weigh(const KnownPoint& point, const Observation& observation,
                          const SE3& camera_from_world, const Camera& camera) {
  Eigen::Matrix2d covariance =
      observation.sigma_px * observation.sigma_px * Eigen::Matrix2d::Identity();
  Camera::Jacobian pixel_by_point;
  if (camera.Project(camera_from_world * point.in_world, &pixel_by_point)) {
    const Camera::Jacobian jacobian = pixel_by_point * camera_from_world.rotation().matrix();
    covariance += jacobian * point.covariance * jacobian.transpose();
  }
  return {point.in_world, observation.pixel, covariance.inverse()};
}

/// The least-squares problem of one pose.
class PoseProblem {
 public:
  PoseProblem(const SE3& initial, const PoseObservations& observations, const Camera& camera)
      : camera_(camera) {
    const SE3 camera_from_world = initial.Inverse();
    for (std::size_t i = 0; i < observations.size(); ++i) {
      observations_.push_back(
          Weigh(observations.points[i], observations.observations[i], camera_from_world, camera));
    }
  }

  /// Returns the pose of least cost over the inliers, with Huber's loss if `robust`.
  SE3 Minimize(const SE3& world_from_camera, const std::vector<char>& is_inlier, bool robust,
               int max_iterations) const {
    const auto build = [&](const SE3& pose) { return Build(pose.Inverse(), is_inlier, robust); };
    const auto plus = [](const SE3& pose, const Eigen::Matrix<double, 6, 1>& step) {
      return pose * SE3::Exp(step);
    };
    return MinimizeLevenbergMarquardt<6>(world_from_camera, build, plus, max_iterations).state;
  }

 private:
  NormalEquations<6> Build(const SE3& camera_from_world, const std::vector<char>& is_inlier,
                           bool robust) const {
    NormalEquations<6> equations;
    for (std::size_t i = 0; i < observations_.size(); ++i) {
      if (is_inlier[i]) Add(observations_[i], camera_from_world, robust, equations);
    }
    return equations;
  }

  /// Adds one observation. For X = T⁻¹ X_w and T ← T Exp([υ ω]): dX = -υ + X × ω.
  void Add(const WeightedObservation& observation, const SE3& camera_from_world, bool robust,
           NormalEquations<6>& equations) const {
    const Eigen::Vector3d in_camera = camera_from_world * observation.in_world;
    Camera::Jacobian pixel_by_point;
    const std::optional<Eigen::Vector2d> projected = camera_.Project(in_camera, &pixel_by_point);
    if (!projected) {
      equations.cost += Evaluate(kUnprojectableError * kUnprojectableError, robust).value;
      return;
    }
    const Eigen::Vector2d residual = *projected - observation.pixel;
    Eigen::Matrix<double, 2, 6> jacobian;
    jacobian.leftCols<3>() = -pixel_by_point;
    jacobian.rightCols<3>() = pixel_by_point * SO3::Hat(in_camera);
    const Loss loss = Evaluate(residual.dot(observation.information * residual), robust);
    const Eigen::Matrix<double, 6, 2> weighted =
        loss.weight * jacobian.transpose() * observation.information;
    equations.cost += loss.value;
    equations.hessian += weighted * jacobian;
    equations.gradient += weighted * residual;
  }

  static Loss Evaluate(double squared_error, bool robust) {
    return robust ? HuberLoss(squared_error, kChiSquare2Dof95) : Loss{squared_error, 1.0};
  }

  const Camera& camera_;
  std::vector<WeightedObservation> observations_;
};

/// Sets the inliers of the estimated pose and their number.
void ClassifyInliers(const PoseObservations& observations, const Camera& camera,
                     PoseEstimate& estimate) {
  const SE3 camera_from_world = estimate.world_from_camera.Inverse();
  estimate.num_inliers = 0;
  for (std::size_t i = 0; i < observations.size(); ++i) {
    const Eigen::Vector3d in_camera = camera_from_world * observations.points[i].in_world;
    estimate.is_inlier[i] =
        SquaredError(in_camera, observations.observations[i], camera) <= kChiSquare2Dof95;
    estimate.num_inliers += estimate.is_inlier[i];
  }
}

}  // namespace

PoseEstimate OptimizePose(const SE3& initial, const PoseObservations& observations,
                          const Camera& camera, const PoseOptimizerOptions& options) {
  constexpr int kMinInliers = 6;  // With fewer a pose is not overdetermined.
  const PoseProblem problem(initial, observations, camera);
  PoseEstimate estimate{initial, std::vector<char>(observations.size(), 1), 0};
  for (int round = 0; round < options.num_rounds; ++round) {
    estimate.world_from_camera =
        problem.Minimize(estimate.world_from_camera, estimate.is_inlier,
                         round < options.num_robust_rounds, options.max_iterations);
    ClassifyInliers(observations, camera, estimate);
    if (estimate.num_inliers < kMinInliers) break;
  }
  return estimate;
}

}  // namespace corvo
