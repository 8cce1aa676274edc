#include "vo/optimization/point_adjuster.h"

#include <cstddef>

#include "vo/math/huber.h"
#include "vo/math/levenberg_marquardt.h"

namespace corvo {
namespace {

constexpr double kHuberThreshold = kHuberSigmas * kHuberSigmas;

void Accumulate(const Camera& camera, const SE3& camera_from_local,
                const Bundle::Observation& observation, const Eigen::Vector3d& in_local,
                NormalEquations<3>& equations) {
  constexpr double kUnseen = 1e6;
  Camera::Jacobian by_camera_point;
  const auto pixel = camera.Project(camera_from_local * in_local, &by_camera_point);
  if (!pixel) {
    equations.cost += HuberLoss(kUnseen, kHuberThreshold).value;
    return;
  }
  const Eigen::Vector2d residual = (*pixel - observation.pixel) / observation.sigma_px;
  const Camera::Jacobian jacobian =
      by_camera_point * camera_from_local.rotation().matrix() / observation.sigma_px;
  const Loss loss = HuberLoss(residual.squaredNorm(), kHuberThreshold);
  equations.cost += loss.value;
  equations.hessian += loss.weight * jacobian.transpose() * jacobian;
  equations.gradient += loss.weight * jacobian.transpose() * residual;
}

}  // namespace

void AdjustPoints(const Camera& camera, const std::vector<char>& is_adjusted, Bundle& bundle) {
  constexpr int kMaxIterations = 5;
  const std::vector<SE3> camera_from_local = CamerasFromLocal(bundle);
  const std::vector<int> offsets = ObservationOffsets(bundle);
  const auto plus = [](const Eigen::Vector3d& point, const Eigen::Vector3d& step) {
    return Eigen::Vector3d(point + step);
  };
  for (std::size_t point = 0; point < bundle.points.size(); ++point) {
    if (is_adjusted[point]) continue;
    const auto build = [&](const Eigen::Vector3d& in_local) {
      NormalEquations<3> equations;
      for (int i = offsets[point]; i < offsets[point + 1]; ++i) {
        const Bundle::Observation& observation = bundle.observations[i];
        if (!observation.is_inlier) continue;
        Accumulate(camera, camera_from_local[observation.view], observation, in_local, equations);
      }
      return equations;
    };
    Eigen::Vector3d& in_local = bundle.points[point].in_local;
    in_local = MinimizeLevenbergMarquardt<3>(in_local, build, plus, kMaxIterations).state;
  }
}

}  // namespace corvo
