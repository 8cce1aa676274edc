// SPDX-License-Identifier: MIT
#include "vo/camera/projection_fov.h"

#include <cmath>
#include <numbers>

namespace corvo::fov {
namespace {

double Stretch(const CameraParameters& p) { return 2 * std::tan(0.5 * p.omega); }

}  // namespace

Distorted Distort(const CameraParameters& p, const Eigen::Vector2d& undistorted) {
  if (p.omega == 0) return {undistorted, Eigen::Matrix2d::Identity()};
  const double r = undistorted.norm();
  const double stretched = Stretch(p) * r;
  return MoveRadially(undistorted, r, std::atan(stretched) / p.omega,
                      Stretch(p) / (p.omega * (1 + stretched * stretched)));
}

double MaxRadius(const CameraParameters&) { return std::tan(kMaxAngle); }

std::optional<Eigen::Vector2d> Undistort(const CameraParameters& p, double max_radius,
                                         const Eigen::Vector2d& target) {
  const double radius = target.norm();
  const double angle = p.omega * radius;
  if (radius == 0) return target;
  if (!(angle < 0.5 * std::numbers::pi)) return std::nullopt;
  const double r = p.omega == 0 ? radius : std::tan(angle) / Stretch(p);
  if (!(r < max_radius)) return std::nullopt;
  return Eigen::Vector2d(r / radius * target);
}

}  // namespace corvo::fov
