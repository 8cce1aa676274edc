// SPDX-License-Identifier: MIT
#include "vo/camera/camera_fit.h"

#include <optional>

#include <Eigen/Geometry>

#include "vo/camera/differentiable_camera.h"
#include "vo/math/levenberg_marquardt.h"

namespace corvo {
namespace {

constexpr int kMaxFitted = 5;  // The focal length and four distortion parameters.
using Difference = Eigen::Matrix<double, kMaxFitted, 1>;

struct ImagedRay {
  Eigen::Vector3d in_camera;
  Eigen::Vector2d pixel;
};

std::vector<ImagedRay> ImageGrid(const Camera& camera) {
  constexpr int kColumns = 16, kRows = 12;
  std::vector<ImagedRay> rays;
  for (int i = 0; i <= kColumns; ++i) {
    for (int j = 0; j <= kRows; ++j) {
      const Eigen::Vector2d pixel(i * (camera.width() - 1.0) / kColumns,
                                  j * (camera.height() - 1.0) / kRows);
      if (const auto ray = camera.Undistort(pixel)) rays.push_back({ray->homogeneous(), pixel});
    }
  }
  return rays;
}

NormalEquations<kMaxFitted> BuildEquations(const CameraPrior& prior, const Difference& difference,
                                           const std::vector<ImagedRay>& rays) {
  constexpr double kUnprojectableErrorPx = 1e3;
  NormalEquations<kMaxFitted> equations;
  const int num_free = prior.num_free();
  const auto camera = DifferentiableCamera::Make(prior, difference.head(num_free));
  if (!camera) {
    equations.cost =
        static_cast<double>(rays.size()) * kUnprojectableErrorPx * kUnprojectableErrorPx;
    return equations;
  }
  for (const ImagedRay& ray : rays) {
    const auto pixel = camera->camera().Project(ray.in_camera);
    if (!pixel) {
      equations.cost += kUnprojectableErrorPx * kUnprojectableErrorPx;
      continue;
    }
    const Eigen::Vector2d error = *pixel - ray.pixel;
    const auto jacobian = camera->PixelByDifference(ray.in_camera, *pixel);
    equations.cost += error.squaredNorm();
    equations.gradient.head(num_free) += jacobian.transpose() * error;
    equations.hessian.topLeftCorner(num_free, num_free) += jacobian.transpose() * jacobian;
  }
  return equations;
}

/// Returns the initial value of the fit. At small angles all models agree.
CameraParameters StartOf(const CameraParameters& camera, CameraModel model) {
  CameraParameters start = WithoutDistortion(camera, model);
  if (model == CameraModel::kFov) start.omega = 0.1;  // The derivative vanishes at 0.
  if (model == CameraModel::kKb4) {                   // The series of the pinhole's tan(theta).
    start.k1 = 1.0 / 3;
    start.k2 = 2.0 / 15;
    start.k3 = 17.0 / 315;
    start.k4 = 62.0 / 2835;
  }
  return start;
}

}  // namespace

std::vector<std::string> DistortionNames(CameraModel model) {
  switch (model) {
    case CameraModel::kPinhole:
      return {"k1", "k2"};
    case CameraModel::kKb4:
      return {"k1", "k2", "k3", "k4"};
    case CameraModel::kFov:
      return {"omega"};
  }
  return {};
}

CameraParameters WithoutDistortion(const CameraParameters& camera, CameraModel model) {
  return {model, camera.width, camera.height, camera.fx, camera.fy, camera.cx, camera.cy};
}

CameraParameters FitCamera(const Camera& camera, CameraModel model) {
  constexpr int kMaxIterations = 50;
  if (camera.parameters().model == model) return camera.parameters();
  CameraPrior prior{StartOf(camera.parameters(), model), {{"focal"}}};
  for (const std::string& name : DistortionNames(model)) prior.free.push_back({name});
  const std::vector<ImagedRay> rays = ImageGrid(camera);
  const Difference difference =
      MinimizeLevenbergMarquardt<kMaxFitted>(
          Difference(Difference::Zero()),
          [&](const Difference& at) { return BuildEquations(prior, at, rays); },
          [](const Difference& at, const Difference& step) { return Difference(at + step); },
          kMaxIterations)
          .state;
  return prior.Apply(difference.head(prior.num_free()));
}

}  // namespace corvo
