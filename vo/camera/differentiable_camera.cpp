// SPDX-License-Identifier: MIT
#include "vo/camera/differentiable_camera.h"

#include <map>

#include <Eigen/Geometry>

#include "vo/camera/projection_fov.h"
#include "vo/camera/projection_kannala_brandt.h"

namespace corvo {
namespace {

/// Returns d (x_d, y_d) / d p1 (axis 1) or d p2 (axis 0) of a point at (x/z, y/z).
Eigen::Vector2d TangentialEffect(const Eigen::Vector2d& normalized, int axis) {
  Eigen::Vector2d effect = Eigen::Vector2d::Constant(2 * normalized.x() * normalized.y());
  effect[axis] = normalized.squaredNorm() + 2 * normalized[axis] * normalized[axis];
  return effect;
}

}  // namespace

DifferentiableCamera::DifferentiableCamera(const CameraPrior& prior,
                                           const Eigen::VectorXd& difference)
    : camera_(prior.Apply(difference)) {
  for (const FreeParameter& parameter : prior.free) {
    effects_.push_back(EffectOf(parameter.name, prior.given.model));
  }
}

std::optional<DifferentiableCamera> DifferentiableCamera::Make(const CameraPrior& prior,
                                                               const Eigen::VectorXd& difference) {
  if (!prior.Apply(difference).IsValid()) return std::nullopt;
  return DifferentiableCamera(prior, difference);
}

DifferentiableCamera::Effect DifferentiableCamera::EffectOf(const std::string& name,
                                                            CameraModel model) {
  static const std::map<std::string, Effect> kOfEveryModel = {{"focal", Effect::kFocal},
                                                              {"fx", Effect::kFx},
                                                              {"fy", Effect::kFy},
                                                              {"cx", Effect::kCx},
                                                              {"cy", Effect::kCy}};
  static const std::map<std::string, Effect> kOfPinholes = {{"k1", Effect::kK1},
                                                            {"k2", Effect::kK2},
                                                            {"p1", Effect::kP1},
                                                            {"p2", Effect::kP2},
                                                            {"k3", Effect::kK3}};
  static const std::map<std::string, Effect> kOfWideLenses = {{"k1", Effect::kTheta3},
                                                              {"k2", Effect::kTheta5},
                                                              {"k3", Effect::kTheta7},
                                                              {"k4", Effect::kTheta9},
                                                              {"omega", Effect::kOmega}};
  const auto of_every_model = kOfEveryModel.find(name);
  if (of_every_model != kOfEveryModel.end()) return of_every_model->second;
  return (model == CameraModel::kPinhole ? kOfPinholes : kOfWideLenses).at(name);
}

Eigen::Vector2d DifferentiableCamera::PixelByParameter(Effect effect,
                                                       const Eigen::Vector3d& in_camera,
                                                       const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d from_center = pixel - Eigen::Vector2d(camera_.cx(), camera_.cy());
  switch (effect) {
    case Effect::kFocal:
      return from_center;
    case Effect::kFx:
      return {from_center.x() / camera_.fx(), 0};
    case Effect::kFy:
      return {0, from_center.y() / camera_.fy()};
    case Effect::kCx:
      return {1, 0};
    case Effect::kCy:
      return {0, 1};
    default:
      break;
  }
  return Eigen::Vector2d(camera_.fx(), camera_.fy())
      .cwiseProduct(DistortedByParameter(effect, in_camera.hnormalized()));
}

Eigen::Vector2d DifferentiableCamera::DistortedByParameter(
    Effect effect, const Eigen::Vector2d& normalized) const {
  const double s = normalized.squaredNorm();
  switch (effect) {
    case Effect::kK1:
      return s * normalized;
    case Effect::kK2:
      return s * s * normalized;
    case Effect::kK3:
      return s * s * s * normalized;
    case Effect::kP1:
      return TangentialEffect(normalized, 1);
    case Effect::kP2:
      return TangentialEffect(normalized, 0);
    case Effect::kTheta3:
      return kannala_brandt::DistortedByCoefficient(1, normalized);
    case Effect::kTheta5:
      return kannala_brandt::DistortedByCoefficient(2, normalized);
    case Effect::kTheta7:
      return kannala_brandt::DistortedByCoefficient(3, normalized);
    case Effect::kTheta9:
      return kannala_brandt::DistortedByCoefficient(4, normalized);
    case Effect::kOmega:
      return fov::DistortedByOmega(camera_.parameters(), normalized);
    default:
      return Eigen::Vector2d::Zero();
  }
}

DifferentiableCamera::Jacobian DifferentiableCamera::PixelByDifference(
    const Eigen::Vector3d& in_camera, const Eigen::Vector2d& pixel) const {
  Jacobian jacobian(2, effects_.size());
  for (std::size_t i = 0; i < effects_.size(); ++i) {
    jacobian.col(i) = PixelByParameter(effects_[i], in_camera, pixel);
  }
  return jacobian;
}

}  // namespace corvo
