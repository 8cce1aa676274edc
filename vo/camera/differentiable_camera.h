// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "vo/camera/camera.h"
#include "vo/camera/camera_prior.h"

namespace corvo {

/// A camera and what its pixels become when the free parameters of a prior change: in closed form
/// but for the distortion of kb4 and fov, which is by central differences.
class DifferentiableCamera {
 public:
  static constexpr int kMaxFree = 12;
  /// d pixel / d difference, one column a free parameter.
  using Jacobian = Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::ColMajor, 2, kMaxFree>;

  /// The camera that differs so much from the one given. Throws corvo::Error where that is none.
  DifferentiableCamera(const CameraPrior& prior, const Eigen::VectorXd& difference);

  /// The same without an exception.
  static std::optional<DifferentiableCamera> Make(const CameraPrior& prior,
                                                  const Eigen::VectorXd& difference);

  const Camera& camera() const { return camera_; }

  /// Of a point that projects to `pixel`.
  Jacobian PixelByDifference(const Eigen::Vector3d& in_camera, const Eigen::Vector2d& pixel) const;

 private:
  enum class Effect { kFocal, kFx, kFy, kCx, kCy, kK1, kK2, kP1, kP2, kK3, kByDifference };

  /// Of a free parameter.
  struct Derivative {
    Effect effect;
    std::optional<Camera> below, above;  // By difference; none at the end of the range.

    Eigen::Vector2d DifferenceQuotient(const Eigen::Vector3d& in_camera,
                                       const Eigen::Vector2d& pixel) const;
  };

  /// d (x_d, y_d) / d parameter of a pinhole's distortion, at (x/z, y/z).
  static Eigen::Vector2d DistortedByParameter(Effect effect, const Eigen::Vector2d& normalized);
  static Effect EffectOf(const std::string& name, CameraModel model);
  Eigen::Vector2d PixelByParameter(const Derivative& derivative, const Eigen::Vector3d& in_camera,
                                   const Eigen::Vector2d& pixel) const;

  Camera camera_;
  std::vector<Derivative> derivatives_;  // One a free parameter.
};

}  // namespace corvo
