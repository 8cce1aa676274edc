// SPDX-License-Identifier: MIT
#include "vo/optimization/point_adjuster.h"

#include <cstddef>
#include <span>

#include "vo/math/huber.h"
#include "vo/math/levenberg_marquardt.h"
#include "vo/optimization/reprojection_error.h"

namespace corvo {
namespace {

/// The least-squares problem of one point.
struct PointProblem {
  const Camera& camera;
  const std::vector<SE3>& camera_from_local;
  std::span<const Bundle::Observation> observations;
  double huber_threshold;

  NormalEquations<3> Build(const Eigen::Vector3d& in_local) const {
    NormalEquations<3> equations;
    for (const Bundle::Observation& observation : observations) {
      if (observation.is_inlier) Add(observation, in_local, equations);
    }
    return equations;
  }

  void Add(const Bundle::Observation& observation, const Eigen::Vector3d& in_local,
           NormalEquations<3>& equations) const {
    const SE3& pose = camera_from_local[observation.view];
    Camera::Jacobian by_camera_point;
    const auto pixel = camera.Project(pose * in_local, &by_camera_point);
    if (!pixel) {
      equations.cost += HuberLoss(kUnprojectableError * kUnprojectableError, huber_threshold).value;
      return;
    }
    const Eigen::Vector2d residual = (*pixel - observation.pixel) / observation.sigma_px;
    const Camera::Jacobian jacobian =
        by_camera_point * pose.rotation().matrix() / observation.sigma_px;
    const Loss loss = HuberLoss(residual.squaredNorm(), huber_threshold);
    equations.cost += loss.value;
    equations.hessian += loss.weight * jacobian.transpose() * jacobian;
    equations.gradient += loss.weight * jacobian.transpose() * residual;
  }
};

}  // namespace

void AdjustPoints(const Camera& camera, const std::vector<char>& is_adjusted,
                  const PointAdjustmentOptions& options, Bundle& bundle) {
  const std::vector<SE3> camera_from_local = CamerasFromLocal(bundle);
  const std::vector<int> offsets = ObservationOffsets(bundle);
  const std::span<const Bundle::Observation> observations = bundle.observations;
  const auto plus = [](const Eigen::Vector3d& point, const Eigen::Vector3d& step) {
    return Eigen::Vector3d(point + step);
  };
  for (std::size_t point = 0; point < bundle.points.size(); ++point) {
    if (is_adjusted[point]) continue;
    const PointProblem problem{
        camera, camera_from_local,
        observations.subspan(offsets[point], offsets[point + 1] - offsets[point]),
        options.huber_sigmas * options.huber_sigmas};
    const auto build = [&](const Eigen::Vector3d& in_local) { return problem.Build(in_local); };
    Eigen::Vector3d& in_local = bundle.points[point].in_local;
    in_local = MinimizeLevenbergMarquardt<3>(in_local, build, plus, options.max_iterations).state;
  }
}

}  // namespace corvo
