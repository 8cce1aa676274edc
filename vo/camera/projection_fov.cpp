// SPDX-License-Identifier: MIT
#include "vo/camera/projection_fov.h"

#include <cmath>
#include <numbers>

namespace corvo::fov {
namespace {

bool IsUndistorted(const CameraParameters& p) { return p.omega < 1e-9; }

double Stretch(const CameraParameters& p) { return 2 * std::tan(0.5 * p.omega); }

}  // namespace

Distorted Distort(const CameraParameters& p, const Eigen::Vector2d& undistorted) {
  if (IsUndistorted(p)) return {undistorted, Eigen::Matrix2d::Identity()};
  const double r = undistorted.norm();
  const double stretched = Stretch(p) * r;
  return MoveRadially(undistorted, r, std::atan(stretched) / p.omega,
                      Stretch(p) / (p.omega * (1 + stretched * stretched)));
}

Eigen::Vector2d DistortedByOmega(const CameraParameters& p, const Eigen::Vector2d& undistorted) {
  if (IsUndistorted(p)) return Eigen::Vector2d::Zero();
  const double r = undistorted.norm();
  const double stretch = Stretch(p);
  const double angle_per_radius = r == 0 ? stretch : std::atan(stretch * r) / r;
  const double stretch_by_omega = 1 + 0.25 * stretch * stretch;
  const double by_omega = stretch_by_omega / (1 + stretch * stretch * r * r);
  return (by_omega - angle_per_radius / p.omega) / p.omega * undistorted;
}

double MaxRadius(const CameraParameters&) { return std::tan(kMaxAngle); }

std::optional<Eigen::Vector2d> Undistort(const CameraParameters& p, double max_radius,
                                         const Eigen::Vector2d& target) {
  const double radius = target.norm();
  const double angle = p.omega * radius;
  if (radius == 0) return target;
  if (!(angle < 0.5 * std::numbers::pi)) return std::nullopt;
  const double r = IsUndistorted(p) ? radius : std::tan(angle) / Stretch(p);
  if (!(r < max_radius)) return std::nullopt;
  return Eigen::Vector2d(r / radius * target);
}

}  // namespace corvo::fov
