// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "vo/camera/camera_parameters.h"
#include "vo/core/options.h"

namespace corvo {

/// A parameter of a camera that is to be estimated.
struct FreeParameter {
  /// The name of a field of CameraParameters that the model has ("fx", "fy", "cx", "cy", "k1",
  /// ...), or "focal", a common factor of fx and fy.
  std::string name;
  /// The standard deviation of the given value in the unit of the value, or as a share of it for
  /// "focal". Infinity if nothing is known.
  double sigma = std::numeric_limits<double>::infinity();
  /// Whether the odometry keeps the given value unless the images are strong evidence against it.
  bool needs_evidence = false;

  bool operator==(const FreeParameter&) const = default;
};

/// Returns the names of all parameters that may be free: "focal" and every parameter of the model.
std::vector<std::string> FreeParameterNames(CameraModel model);

/// A given camera and those of its parameters that are uncertain: a calibration is a measurement.
/// Any other camera is described by its difference d from the given one, with one entry per free
/// parameter, in the order of `free`:
///
///     focal: fx = exp(d) fx_given, fy = exp(d) fy_given          any other: value = given + d
struct CameraPrior {
  CameraParameters given;
  std::vector<FreeParameter> free;

  int num_free() const { return static_cast<int>(free.size()); }
  /// Returns the indices of the free parameters that need no evidence.
  std::vector<int> IndicesWithoutEvidence() const;

  /// Throws corvo::Error if `given` is invalid (see CameraParameters::Validate), or naming the
  /// first free parameter that the model does not have, that occurs twice ("focal" counts as fx and
  /// fy) or whose sigma is not above 0.
  void Validate() const;

  /// Returns the camera that differs from the given one by `difference`. It may be out of range.
  CameraParameters Apply(const Eigen::VectorXd& difference) const;
  /// Returns the inverse of Apply for a camera whose fixed parameters are those of `given`.
  Eigen::VectorXd Difference(const CameraParameters& camera) const;
  /// Returns the χ² of a difference: the sum of (d / sigma)².
  double SquaredError(const Eigen::VectorXd& difference) const;
  /// Returns whether a difference is consistent with the sigmas: its χ² is at most the 99.9%
  /// quantile. Parameters that have their given value for want of evidence do not count. If it is
  /// not, the camera is not the given one, and the remaining error was absorbed
  /// by parameters that cannot express it.
  bool PassesChiSquareTest(const Eigen::VectorXd& difference) const;

  /// Returns the prior with every sigma multiplied by sqrt(`information`). Used with unweighted
  /// observations, it has the same effect as this prior with observations whose information counts
  /// `information` times.
  CameraPrior Inflated(double information) const;

  /// Returns the prior of the same images resized, see Camera::Resized.
  CameraPrior Resized(int width, int height) const;

  bool operator==(const CameraPrior&) const = default;
};

/// Returns the prior of a camera that is given without sigmas. The focal length and k1 and k2, or
/// omega, are free: a calibrated camera keeps a residual distortion, which bends the scale of a map
/// wherever the camera turns. The principal point, which can hardly be told from a rotation of the
/// camera, and p1 and p2 are free where the images are evidence against the given values. k3 and k4
/// are exact, because k1 and k2 take over their effect.
CameraPrior MakePrior(const CameraParameters& given, const CalibrationOptions& options);

/// An estimate of a camera: its difference from the given camera, and the covariance of the
/// difference.
struct CameraEstimate {
  Eigen::VectorXd difference;
  Eigen::MatrixXd covariance;
  /// Whether the parts of the sequence agree on the camera. If not, it was zoomed or focused, or
  /// its model lacks something; the covariance is then inflated, see CameraBlocks.
  bool is_consistent = true;
};

/// Returns the information of the prior: a diagonal matrix, with zeros for what is unknown.
Eigen::MatrixXd PriorInformation(const CameraPrior& prior);

/// Returns the estimate before the first image: no difference, with the variances of the prior.
CameraEstimate PriorEstimate(const CameraPrior& prior);

/// Returns the free parameters with the standard deviations given by the covariance of their
/// difference.
std::vector<FreeParameter> Posterior(std::vector<FreeParameter> free,
                                     const Eigen::MatrixXd& covariance);

/// Returns the share of the information about a parameter that comes from the images, 0 to 1; the
/// rest comes from the prior `parameter`. `sigma` is the posterior standard deviation.
double InformationGain(const FreeParameter& parameter, double sigma);

/// Returns the value of a parameter that the camera's model has; for "focal" it is fx.
double ValueOf(const CameraParameters& camera, const std::string& name);

}  // namespace corvo
