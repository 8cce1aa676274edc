// SPDX-License-Identifier: MIT
#include "tests/fuzz/cameras.h"
#include "tests/fuzz/targets.h"
#include "vo/camera/camera.h"
#include "vo/camera/camera_fit.h"

namespace corvo::fuzz {
namespace {

void RequireProjection(const Camera& camera, const Eigen::Vector3d& point) {
  if (std::abs(point.z()) < 1e-9) return;  // So near, a derivative may exceed every number.
  Camera::Jacobian jacobian = Camera::Jacobian::Zero();
  const auto pixel = camera.Project(point, &jacobian);
  Require(pixel == camera.Project(point), "the Jacobian does not change the pixel");
  if (!pixel || !camera.Contains(*pixel)) return;
  Require(jacobian.allFinite(), "the Jacobian at a pixel of the image is finite");
}

void RequireRay(const Camera& camera, const Eigen::Vector2d& pixel) {
  const auto ray = camera.Undistort(pixel);
  if (!ray) return;
  Require(ray->allFinite(), "a ray is finite");
  Require(ray->norm() <= camera.max_radius() * (1 + 1e-9), "a ray is inside max_radius()");
  Require(std::isfinite(camera.FocalAt(*ray)), "the focal length at a ray is finite");
}

}  // namespace

void FuzzCamera(Bytes bytes) {
  Input input(bytes);
  const int width = input.Int(1, 4000), height = input.Int(1, 4000);
  const CameraParameters parameters = TakeCamera(width, height, input.Bool(), input);
  const std::optional<Camera> camera = Camera::Make(parameters);
  Require(camera.has_value() == parameters.IsValid(), "only valid cameras are made");
  if (!camera) return;
  const bool is_fitted = input.Int(0, 15) == 0;
  for (int i = 0; i < 20; ++i) {
    const double x = input.Number(1e6), y = input.Number(1e6), z = input.Number(1e6);
    RequireProjection(*camera, {x, y, z});
    RequireRay(*camera, {x, y});
    const double column = input.Real(-0.5, width - 0.5), row = input.Real(-0.5, height - 0.5);
    RequireRay(*camera, {column, row});
  }
  AllowError([&] { camera->Resized(width / 2 + 1, height / 2 + 1); });
  if (!is_fitted) return;
  AllowError([&] {
    for (const CameraModel model : {CameraModel::kPinhole, CameraModel::kKb4, CameraModel::kFov}) {
      FitCamera(*camera, model).Validate();
    }
  });
}

}  // namespace corvo::fuzz
