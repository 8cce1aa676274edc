// SPDX-License-Identifier: MIT
#include "apps/export/point_fit.h"

#include <limits>
#include <vector>

#include "vo/camera/camera.h"
#include "vo/math/levenberg_marquardt.h"

namespace corvo {
namespace {

struct PixelInView {
  const SE3* camera_from_world;
  Eigen::Vector2d pixel;
};

/// Returns the observations of each point.
std::vector<std::vector<PixelInView>> GroupByPoint(const Reconstruction& reconstruction,
                                                   const std::vector<SE3>& cameras_from_world) {
  std::vector<std::vector<PixelInView>> groups(reconstruction.points.size());
  for (std::size_t i = 0; i < reconstruction.images.size(); ++i) {
    for (const PointObservation& o : reconstruction.images[i].observations) {
      groups[o.point].push_back({&cameras_from_world[i], o.pixel});
    }
  }
  return groups;
}

/// Returns the normal equations of the squared errors of a point. A point that a view cannot
/// project has an infinite cost.
NormalEquations<3> SquaredErrors(const Camera& camera, const std::vector<PixelInView>& views,
                                 const Eigen::Vector3d& in_world) {
  NormalEquations<3> equations;
  for (const auto& [camera_from_world, observed] : views) {
    Camera::Jacobian by_camera_point;
    const auto pixel = camera.Project(*camera_from_world * in_world, &by_camera_point);
    if (!pixel) {
      equations.cost = std::numeric_limits<double>::infinity();
      continue;
    }
    const Eigen::Vector2d error = *pixel - observed;
    const Camera::Jacobian by_point = by_camera_point * camera_from_world->rotation().matrix();
    equations.cost += error.squaredNorm();
    equations.hessian += by_point.transpose() * by_point;
    equations.gradient += by_point.transpose() * error;
  }
  return equations;
}

}  // namespace

void FitPointsToPixels(Reconstruction& reconstruction) {
  constexpr int kMaxIterations = 20;
  const Camera camera(reconstruction.camera);
  std::vector<SE3> cameras_from_world;
  for (const ReconstructedImage& image : reconstruction.images) {
    cameras_from_world.push_back(image.world_from_camera.Inverse());
  }
  const auto groups = GroupByPoint(reconstruction, cameras_from_world);
  const auto plus = [](const Eigen::Vector3d& point, const Eigen::Vector3d& step) {
    return Eigen::Vector3d(point + step);
  };
  for (std::size_t i = 0; i < groups.size(); ++i) {
    const auto build = [&](const Eigen::Vector3d& in_world) {
      return SquaredErrors(camera, groups[i], in_world);
    };
    Eigen::Vector3d& in_world = reconstruction.points[i].in_world;
    in_world = MinimizeLevenbergMarquardt<3>(in_world, build, plus, kMaxIterations).state;
  }
}

}  // namespace corvo
