// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "vo/camera/camera_parameters.h"
#include "vo/core/options.h"

namespace corvo {

/// A number of a camera that is to be estimated.
struct FreeParameter {
  /// Of a field of CameraParameters that the model has ("fx", "fy", "cx", "cy", "k1", ...); or
  /// "focal", a factor of both fx and fy.
  std::string name;
  /// Standard deviation of the given value, in its own unit (focal: as a share of it); infinity:
  /// nothing is known.
  double sigma = std::numeric_limits<double>::infinity();

  bool operator==(const FreeParameter&) const = default;
};

/// Names of what may be free: "focal" and every parameter of the model.
std::vector<std::string> FreeParameterNames(CameraModel model);

/// A camera that is given, and what of it is not known exactly: a calibration is a measurement.
/// Every other camera is told by its difference d from it, one number a free parameter, in their
/// order:
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
  /// Whether a difference is one that the sigmas allow: its χ² lies under the 99.9% quantile. If
  /// not, the camera is not the one that was given, and what is left over of the error has been
  /// pressed into parameters that cannot express it.
  bool PassesChiSquareTest(const Eigen::VectorXd& difference) const;

  /// What the prior is worth beside images whose information counts `information` times.
  CameraPrior Inflated(double information) const;

  /// The prior of the same images resized, see Camera::Resized.
  CameraPrior Resized(int width, int height) const;

  bool operator==(const CameraPrior&) const = default;
};

/// A camera of which no sigmas are given: free are the focal length and, as a measured camera keeps
/// a residual distortion, which bends the scale of a map wherever the camera turns, k1 and k2; of
/// the pinhole model only. Its principal point is not told from a turn of the camera, and stays.
CameraPrior MakePrior(const CameraParameters& given, const CalibrationOptions& options);

/// What is known of a camera: its difference from what was given, and how surely.
struct CameraEstimate {
  Eigen::VectorXd difference;
  Eigen::MatrixXd covariance;
};

/// What is known before the first image.
CameraEstimate PriorEstimate(const CameraPrior& prior);

/// The free parameters, known as the covariance of their difference says.
std::vector<FreeParameter> Posterior(std::vector<FreeParameter> free,
                                     const Eigen::MatrixXd& covariance);

/// What of the information about a parameter came from the images, 0 to 1: the rest was known
/// before. `sigma` is what is known with them.
double InformationGain(const FreeParameter& parameter, double sigma);

/// A parameter that the camera's model has; of "focal" it is fx.
double ValueOf(const CameraParameters& camera, const std::string& name);

}  // namespace corvo
