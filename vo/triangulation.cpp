#include "vo/triangulation.h"

#include <cmath>

#include <Eigen/SVD>

namespace corvo {
namespace {

/// The two linear equations that a ray puts on a homogeneous point in the world.
Eigen::Matrix<double, 2, 4> RayEquations(const PosedRay& view) {
  const Eigen::Matrix<double, 3, 4> camera_from_world =
      view.world_from_camera.Inverse().matrix().topRows<3>();
  Eigen::Matrix<double, 2, 4> equations;
  equations.row(0) = view.ray.x() * camera_from_world.row(2) - camera_from_world.row(0);
  equations.row(1) = view.ray.y() * camera_from_world.row(2) - camera_from_world.row(1);
  return equations;
}

double Angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

std::optional<Eigen::Vector3d> Triangulate(const PosedRay& a, const PosedRay& b) {
  Eigen::Matrix4d equations;
  equations << RayEquations(a), RayEquations(b);
  const Eigen::JacobiSVD<Eigen::Matrix4d> svd(equations, Eigen::ComputeFullV);
  const Eigen::Vector4d homogeneous = svd.matrixV().col(3);
  if (std::abs(homogeneous.w()) < 1e-9 * homogeneous.head<3>().norm()) return std::nullopt;
  return Eigen::Vector3d(homogeneous.hnormalized());
}

double RayAngle(const PosedRay& a, const PosedRay& b) {
  return Angle(a.world_from_camera.rotation() * a.ray.homogeneous(),
               b.world_from_camera.rotation() * b.ray.homogeneous());
}

double ParallaxAngle(const Eigen::Vector3d& in_world, const SE3& world_from_a,
                     const SE3& world_from_b) {
  return Angle(world_from_a.translation() - in_world, world_from_b.translation() - in_world);
}

}  // namespace corvo
