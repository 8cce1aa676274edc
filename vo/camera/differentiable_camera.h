// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "vo/camera/camera.h"
#include "vo/camera/camera_prior.h"

namespace corvo {

/// A camera and the derivatives of its pixels with respect to the free parameters of a prior, in
/// closed form.
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
  /// What a free parameter changes; kTheta3 to kTheta9 are k1 to k4 of kb4.
  enum class Effect {
    kFocal,
    kFx,
    kFy,
    kCx,
    kCy,
    kK1,
    kK2,
    kK3,
    kP1,
    kP2,
    kTheta3,
    kTheta5,
    kTheta7,
    kTheta9,
    kOmega
  };

  /// Returns d (x_d, y_d) / d parameter of the distortion at (x/z, y/z).
  Eigen::Vector2d DistortedByParameter(Effect effect, const Eigen::Vector2d& normalized) const;
  static Effect EffectOf(const std::string& name, CameraModel model);
  Eigen::Vector2d PixelByParameter(Effect effect, const Eigen::Vector3d& in_camera,
                                   const Eigen::Vector2d& pixel) const;

  Camera camera_;
  std::vector<Effect> effects_;  // One per free parameter.
};

}  // namespace corvo
