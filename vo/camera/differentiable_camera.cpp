// SPDX-License-Identifier: MIT
#include "vo/camera/differentiable_camera.h"

#include <algorithm>
#include <map>

#include <Eigen/Geometry>

namespace corvo {
namespace {

constexpr double kStep = 1e-6;  // Small compared with a distortion, large compared with rounding.

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
  for (int i = 0; i < prior.num_free(); ++i) {
    Derivative derivative{EffectOf(prior.free[i].name, prior.given.model), {}, {}};
    if (derivative.effect == Effect::kByDifference) {
      const Eigen::VectorXd change = kStep * Eigen::VectorXd::Unit(prior.num_free(), i);
      derivative.below = Camera::Make(prior.Apply(difference - change));
      derivative.above = Camera::Make(prior.Apply(difference + change));
    }
    derivatives_.push_back(derivative);
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
  const auto of_every_model = kOfEveryModel.find(name);
  if (of_every_model != kOfEveryModel.end()) return of_every_model->second;
  const auto of_pinholes = kOfPinholes.find(name);
  const bool is_pinholes = model == CameraModel::kPinhole && of_pinholes != kOfPinholes.end();
  return is_pinholes ? of_pinholes->second : Effect::kByDifference;
}

Eigen::Vector2d DifferentiableCamera::PixelByParameter(const Derivative& derivative,
                                                       const Eigen::Vector3d& in_camera,
                                                       const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d from_center = pixel - Eigen::Vector2d(camera_.cx(), camera_.cy());
  switch (derivative.effect) {
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
    case Effect::kByDifference:
      return derivative.DifferenceQuotient(in_camera, pixel);
    default:
      break;
  }
  return Eigen::Vector2d(camera_.fx(), camera_.fy())
      .cwiseProduct(DistortedByParameter(derivative.effect, in_camera.hnormalized()));
}

Eigen::Vector2d DifferentiableCamera::DistortedByParameter(Effect effect,
                                                           const Eigen::Vector2d& normalized) {
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
    default:
      return Eigen::Vector2d::Zero();
  }
}

Eigen::Vector2d DifferentiableCamera::Derivative::DifferenceQuotient(
    const Eigen::Vector3d& in_camera, const Eigen::Vector2d& pixel) const {
  const auto low = below ? below->Project(in_camera) : std::nullopt;
  const auto high = above ? above->Project(in_camera) : std::nullopt;
  const int num_steps = (low ? 1 : 0) + (high ? 1 : 0);
  return (high.value_or(pixel) - low.value_or(pixel)) / (kStep * std::max(1, num_steps));
}

DifferentiableCamera::Jacobian DifferentiableCamera::PixelByDifference(
    const Eigen::Vector3d& in_camera, const Eigen::Vector2d& pixel) const {
  Jacobian jacobian(2, derivatives_.size());
  for (std::size_t i = 0; i < derivatives_.size(); ++i) {
    jacobian.col(i) = PixelByParameter(derivatives_[i], in_camera, pixel);
  }
  return jacobian;
}

}  // namespace corvo
