#pragma once

#include <Eigen/Core>

#include "vo/camera_parameters.h"
#include "vo/camera_prior.h"
#include "vo/options.h"

namespace corvo {

/// What is estimated of a camera, as its difference from what was given:
///
///     fx = exp(c0) fx_given     fy = exp(c0) fy_given     k1 = k1_given + c1     k2 = k2_given +
///     c2
///
/// A measured camera keeps a residual distortion, which bends the scale of a map wherever the
/// camera turns; its principal point is not told from a turn of the camera, and stays.
using Calibration = Eigen::Vector3d;

/// The pinhole model only; others stay as they are given.
bool IsCalibrated(CameraModel model);

CameraParameters ApplyCalibration(const CameraParameters& given, const Calibration& calibration);

/// How sure the given camera is: standard deviations of a Calibration.
Eigen::Vector3d PriorSigmas(const CalibrationOptions& options);

/// The given camera with the numbers of a Calibration free.
CameraPrior MakePrior(const CameraParameters& given, const CalibrationOptions& options);

struct CalibrationEstimate {
  Calibration calibration = Calibration::Zero();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// What is known before the first picture.
CalibrationEstimate PriorEstimate(const CalibrationOptions& options);

/// Whether an estimate is one that the given sigmas allow: its χ² with three degrees of freedom
/// lies under the 99.9% quantile. If not, the camera is not the one that was given, and what is
/// left over of the error has been pressed into parameters that cannot express it.
bool IsWithinPrior(const Calibration& calibration, const CalibrationOptions& options);

/// Derivative of a pixel of the pinhole model, seen at (x/z, y/z), by the calibration.
Eigen::Matrix<double, 2, 3> PixelByCalibration(const CameraParameters& parameters,
                                               const Eigen::Vector2d& normalized,
                                               const Eigen::Vector2d& pixel);

}  // namespace corvo
