#include "vo/calibration.h"

#include <cmath>

namespace corvo {

bool IsCalibrated(CameraModel model) { return model == CameraModel::kPinhole; }

CameraParameters ApplyCalibration(const CameraParameters& given, const Calibration& calibration) {
  CameraParameters applied = given;
  applied.fx *= std::exp(calibration[0]);
  applied.fy *= std::exp(calibration[0]);
  applied.k1 += calibration[1];
  applied.k2 += calibration[2];
  return applied;
}

Eigen::Vector3d PriorSigmas(const CalibrationOptions& options) {
  return {options.focal_sigma, options.k1_sigma, options.k2_sigma};
}

CameraPrior MakePrior(const CameraParameters& given, const CalibrationOptions& options) {
  return {given,
          {{"focal", options.focal_sigma}, {"k1", options.k1_sigma}, {"k2", options.k2_sigma}}};
}

CalibrationEstimate PriorEstimate(const CalibrationOptions& options) {
  return {Calibration::Zero(), PriorSigmas(options).cwiseAbs2().asDiagonal()};
}

bool IsWithinPrior(const Calibration& calibration, const CalibrationOptions& options) {
  constexpr double kChiSquare3Dof999 = 16.26623619623813;
  return calibration.cwiseQuotient(PriorSigmas(options)).squaredNorm() <= kChiSquare3Dof999;
}

Eigen::Matrix<double, 2, 3> PixelByCalibration(const CameraParameters& parameters,
                                               const Eigen::Vector2d& normalized,
                                               const Eigen::Vector2d& pixel) {
  const double s = normalized.squaredNorm();
  const Eigen::Vector2d from_centre = pixel - Eigen::Vector2d(parameters.cx, parameters.cy);
  const Eigen::Vector2d radial(parameters.fx * normalized.x(), parameters.fy * normalized.y());
  Eigen::Matrix<double, 2, 3> derivative;
  derivative << from_centre, s * radial, s * s * radial;
  return derivative;
}

}  // namespace corvo
