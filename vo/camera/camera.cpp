// SPDX-License-Identifier: MIT
#include "vo/camera/camera.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "orb/error.h"
#include "vo/camera/projection_fov.h"
#include "vo/camera/projection_kannala_brandt.h"
#include "vo/camera/projection_radtan.h"

namespace corvo {
namespace {

constexpr double kMinRelativeFocal = 1e-6;  // The least FocalAt() relative to that on the axis.

double MaxRadius(const CameraParameters& parameters) {
  switch (parameters.model) {
    case CameraModel::kKb4:
      return kannala_brandt::MaxRadius(parameters);
    case CameraModel::kFov:
      return fov::MaxRadius(parameters);
    case CameraModel::kPinhole:
      break;
  }
  return radtan::MaxRadius(parameters);
}

Distorted Distort(const CameraParameters& parameters, const Eigen::Vector2d& undistorted) {
  switch (parameters.model) {
    case CameraModel::kKb4:
      return kannala_brandt::Distort(parameters, undistorted);
    case CameraModel::kFov:
      return fov::Distort(parameters, undistorted);
    case CameraModel::kPinhole:
      break;
  }
  return radtan::Distort(parameters, undistorted);
}

}  // namespace

Camera::Camera(const CameraParameters& parameters) : parameters_(parameters) {
  parameters.Validate();
  max_radius_ = MaxRadius(parameters);
}

std::optional<Camera> Camera::Make(const CameraParameters& parameters) {
  if (!parameters.IsValid()) return std::nullopt;
  return Camera(parameters);
}

std::optional<Eigen::Vector2d> Camera::Project(const Eigen::Vector3d& point_in_camera,
                                               Jacobian* jacobian) const {
  const double z = point_in_camera.z();
  if (!(z > 0)) return std::nullopt;
  const Eigen::Vector2d normalized = point_in_camera.head<2>() / z;
  if (!(normalized.norm() < max_radius_)) return std::nullopt;
  const Distorted distorted = Distort(parameters_, normalized);
  const Eigen::Vector2d focals(fx(), fy());
  if (jacobian) {
    const Eigen::Matrix2d by_normalized = focals.asDiagonal() * distorted.jacobian / z;
    *jacobian << by_normalized, -by_normalized * normalized;
    if (!jacobian->allFinite()) return std::nullopt;
  }
  const Eigen::Vector2d pixel = focals.cwiseProduct(distorted.point) + Eigen::Vector2d(cx(), cy());
  if (!pixel.allFinite()) return std::nullopt;
  return pixel;
}

std::optional<Eigen::Vector2d> Camera::Undistort(const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d target((pixel.x() - cx()) / fx(), (pixel.y() - cy()) / fy());
  if (!std::isfinite(target.norm())) return std::nullopt;
  switch (parameters_.model) {
    case CameraModel::kKb4:
      return kannala_brandt::Undistort(parameters_, max_radius_, target);
    case CameraModel::kFov:
      return fov::Undistort(parameters_, max_radius_, target);
    case CameraModel::kPinhole:
      break;
  }
  return radtan::Undistort(parameters_, max_radius_, target);
}

double Camera::FocalAt(const Eigen::Vector2d& ray) const {
  if (!ray.allFinite()) throw Error("FocalAt: the ray is not finite");
  if (parameters_.model == CameraModel::kPinhole) return focal();
  const Eigen::Matrix2d pixel_by_ray =
      Eigen::Vector2d(fx(), fy()).asDiagonal() * Distort(parameters_, ray).jacobian;
  // At max_radius() the derivative may be singular, and the quotient 0 or not a number.
  const double focal_at_ray = std::sqrt(2.0 / pixel_by_ray.inverse().squaredNorm());
  const double min_focal = kMinRelativeFocal * std::min(fx(), fy());
  return focal_at_ray > min_focal ? focal_at_ray : min_focal;
}

Camera Camera::Resized(int width, int height) const {
  if (width == parameters_.width && height == parameters_.height) return *this;
  const double scale_x = static_cast<double>(width) / parameters_.width;
  const double scale_y = static_cast<double>(height) / parameters_.height;
  CameraParameters resized = parameters_;
  resized.width = width;
  resized.height = height;
  resized.fx *= scale_x;
  resized.fy *= scale_y;
  resized.cx = (parameters_.cx + 0.5) * scale_x - 0.5;
  resized.cy = (parameters_.cy + 0.5) * scale_y - 0.5;
  return Camera(resized);
}

bool Camera::Contains(const Eigen::Vector2d& pixel) const {
  return pixel.x() >= -0.5 && pixel.x() < width() - 0.5 && pixel.y() >= -0.5 &&
         pixel.y() < height() - 0.5;
}

}  // namespace corvo
