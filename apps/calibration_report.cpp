#include "apps/calibration_report.h"

#include <array>
#include <cmath>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

namespace corvo {
namespace {

/// One number of a camera.
struct Estimated {
  const char* name;
  double given;
  double value;
  double sigma;
  double share_from_data;  ///< Of the information about it.
};

std::array<Estimated, 3> ListEstimated(const Odometry& odometry) {
  const CameraParameters& given = odometry.given_camera();
  const CameraParameters& camera = odometry.camera().parameters();
  const Eigen::Vector3d sigmas = odometry.calibration().covariance.diagonal().cwiseSqrt();
  const Eigen::Vector3d priors = PriorSigmas(odometry.options().calibration);
  const Eigen::Vector3d shares = 1 - sigmas.cwiseQuotient(priors).array().square();
  return {{{"fx", given.fx, camera.fx, camera.fx * sigmas[0], shares[0]},
           {"k1", given.k1, camera.k1, sigmas[1], shares[1]},
           {"k2", given.k2, camera.k2, sigmas[2], shares[2]}}};
}

bool IsEstimated(const Odometry& odometry) {
  return odometry.options().calibration.enabled && IsCalibrated(odometry.given_camera().model);
}

}  // namespace

nlohmann::ordered_json CalibrationJson(const Odometry& odometry) {
  if (!IsEstimated(odometry)) return nullptr;
  nlohmann::ordered_json json = {{"contradicts_given", odometry.contradicts_given_camera()}};
  for (const Estimated& e : ListEstimated(odometry)) {
    json[e.name] = {{"given", e.given},
                    {"value", e.value},
                    {"sigma", e.sigma},
                    {"share_from_data", e.share_from_data}};
  }
  return json;
}

std::string CalibrationText(const Odometry& odometry) {
  if (!IsEstimated(odometry)) return "";
  std::string text = "camera:";
  for (const Estimated& e : ListEstimated(odometry)) {
    text += fmt::format(" {} {:.4g} ± {:.2g} (given {:.4g}, {:.0f}% from the pictures)", e.name,
                        e.value, e.sigma, e.given, 100 * e.share_from_data);
  }
  return text + "\n";
}

void WarnOfContradiction(const Odometry& odometry) {
  if (!odometry.contradicts_given_camera()) return;
  spdlog::warn(
      "the pictures contradict the given camera by more than its standard deviations allow; it was "
      "used as given: check its focal length and distortion, or say how uncertain they are "
      "(calibration.focal_sigma, k1_sigma, k2_sigma)");
}

}  // namespace corvo
