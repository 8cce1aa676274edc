#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "vo/camera.h"
#include "vo/camera_prior.h"

namespace corvo {

/// A camera and what its pixels become when the free parameters of a prior change, by central
/// differences: whatever the model.
class DifferentiableCamera {
 public:
  static constexpr int kMaxFree = 12;
  /// d pixel / d difference, one column a free parameter.
  using Jacobian = Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::ColMajor, 2, kMaxFree>;

  /// The camera that differs so much from the one given. Throws corvo::Error where that is none.
  DifferentiableCamera(const CameraPrior& prior, const Eigen::VectorXd& difference);

  const Camera& camera() const { return camera_; }

  /// Of a point that projects to `pixel`.
  Jacobian PixelByDifference(const Eigen::Vector3d& in_camera, const Eigen::Vector2d& pixel) const;

 private:
  struct Neighbors {
    std::optional<Camera> below, above;  // None at the end of a parameter's range.
    double step = 0;                     // From the camera to either.
  };

  Camera camera_;
  std::vector<Neighbors> neighbors_;  // One a free parameter.
};

}  // namespace corvo
