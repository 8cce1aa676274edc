// SPDX-License-Identifier: MIT
#include "vo/geometry/triangulation.h"

#include <algorithm>
#include <cmath>

#include "vo/geometry/essential_matrix.h"

namespace corvo {
namespace {

struct RayPair {
  Eigen::Vector2d a, b;
};

/// Returns the nearest rays that intersect, a' E b = 0: "niter2" of the paper, which is exact
/// except for rays that miss each other by far.
RayPair MakeMeet(RayPair rays, const Eigen::Matrix3d& essential) {
  const Eigen::Matrix2d corner = essential.topLeftCorner<2, 2>();
  const Eigen::Vector3d line_in_a = essential * rays.b.homogeneous();
  Eigen::Vector2d normal_a = line_in_a.head<2>();
  Eigen::Vector2d normal_b = (essential.transpose() * rays.a.homogeneous()).head<2>();
  const double curvature = normal_a.dot(corner * normal_b);
  const double half_norm = 0.5 * (normal_a.squaredNorm() + normal_b.squaredNorm());
  const double miss = rays.a.homogeneous().dot(line_in_a);
  const double root = std::sqrt(std::max(half_norm * half_norm - curvature * miss, 0.0));
  if (!(half_norm + root > 0)) return rays;
  const double step = miss / (half_norm + root);
  const Eigen::Vector2d start_a = normal_a, start_b = normal_b;
  normal_a -= step * (corner * start_b);
  normal_b -= step * (corner.transpose() * start_a);
  const double norm = normal_a.squaredNorm() + normal_b.squaredNorm();
  if (!(norm > 0)) return rays;
  const double corrected = 2 * step * root / norm;
  return {rays.a - corrected * normal_a, rays.b - corrected * normal_b};
}

double Angle(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

}  // namespace

std::optional<Eigen::Vector3d> Triangulate(const PosedRay& a, const PosedRay& b) {
  const SE3 a_from_b = a.world_from_camera.Inverse() * b.world_from_camera;
  const Eigen::Matrix3d rotation = a_from_b.rotation().matrix();
  const Eigen::Matrix3d essential = EssentialMatrix(a_from_b);
  const RayPair met = MakeMeet({a.ray, b.ray}, essential);
  const Eigen::Vector3d in_b = rotation * met.b.homogeneous();
  const Eigen::Vector3d normal = met.a.homogeneous().cross(in_b);
  const double squared_sine = normal.squaredNorm();
  if (squared_sine < 1e-18 * in_b.squaredNorm()) return std::nullopt;
  const double depth = normal.dot(essential * met.b.homogeneous()) / squared_sine;
  return a.world_from_camera * Eigen::Vector3d(depth * met.a.homogeneous());
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
