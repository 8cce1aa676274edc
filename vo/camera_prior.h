#pragma once

#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "vo/camera_parameters.h"

namespace corvo {

/// A number of a camera that is to be estimated.
struct FreeParameter {
  /// Of a field of CameraParameters that the model has ("fx", "fy", "cx", "cy", "k1", ...); or
  /// "focal", a factor of both fx and fy.
  std::string name;
  /// Standard deviation of the given value, in its own unit (focal: as a share of it); infinity:
  /// nothing is known.
  double sigma = std::numeric_limits<double>::infinity();
};

/// A camera that is given, and what of it is not known exactly. Every other camera is told by its
/// difference d from it, one number a free parameter, in their order:
///
///     focal: fx = exp(d) fx_given, fy = exp(d) fy_given          any other: value = given + d
struct CameraPrior {
  CameraParameters given;
  std::vector<FreeParameter> free;

  int num_free() const { return static_cast<int>(free.size()); }

  /// Throws corvo::Error naming the first parameter that the model does not have, that is there
  /// twice (focal is fx and fy), or whose sigma is not over 0; and as CameraParameters::Validate.
  void Validate() const;

  /// May be out of a camera's range.
  CameraParameters Apply(const Eigen::VectorXd& difference) const;
  /// The inverse of Apply, for a camera whose other numbers are those given.
  Eigen::VectorXd Difference(const CameraParameters& camera) const;
  /// χ² of a difference: the sum of (d / sigma)².
  double SquaredError(const Eigen::VectorXd& difference) const;
};

}  // namespace corvo
