// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "vo/camera/camera.h"
#include "vo/camera/camera_prior.h"

namespace corvo {

/// A camera and the derivatives of its pixels with respect to the free parameters of a prior: in
/// closed form, except for the distortion of kb4 and fov, which uses central differences.
class DifferentiableCamera {
 public:
  static constexpr int kMaxFree = 12;
  /// The derivative d pixel / d difference, with one column per free parameter.
  using Jacobian = Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::ColMajor, 2, kMaxFree>;

  /// Constructs the camera that differs from the given one by `difference`. Throws corvo::Error if
  /// that is not a valid camera.
  DifferentiableCamera(const CameraPrior& prior, const Eigen::VectorXd& difference);

  /// Like the constructor, but returns std::nullopt instead of throwing.
  static std::optional<DifferentiableCamera> Make(const CameraPrior& prior,
                                                  const Eigen::VectorXd& difference);

  const Camera& camera() const { return camera_; }

  /// Returns the derivative for a point that projects to `pixel`.
  Jacobian PixelByDifference(const Eigen::Vector3d& in_camera, const Eigen::Vector2d& pixel) const;

 private:
  enum class Effect { kFocal, kFx, kFy, kCx, kCy, kK1, kK2, kP1, kP2, kK3, kByDifference };

  /// The derivative with respect to one free parameter.
  struct Derivative {
    Effect effect;
    std::optional<Camera> below, above;  // For kByDifference; empty at the end of the range.

    Eigen::Vector2d DifferenceQuotient(const Eigen::Vector3d& in_camera,
                                       const Eigen::Vector2d& pixel) const;
  };

  /// Returns d (x_d, y_d) / d parameter of a pinhole's distortion at (x/z, y/z).
  static Eigen::Vector2d DistortedByParameter(Effect effect, const Eigen::Vector2d& normalized);
  static Effect EffectOf(const std::string& name, CameraModel model);
  Eigen::Vector2d PixelByParameter(const Derivative& derivative, const Eigen::Vector3d& in_camera,
                                   const Eigen::Vector2d& pixel) const;

  Camera camera_;
  std::vector<Derivative> derivatives_;  // One per free parameter.
};

}  // namespace corvo
