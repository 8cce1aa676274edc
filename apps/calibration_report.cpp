#include "apps/calibration_report.h"

#include <cmath>

#include <fmt/format.h>
#include <spdlog/spdlog.h>

namespace corvo {

CalibrationReport ReportCalibration(const Odometry& odometry,
                                    const std::optional<Refinement>& refinement) {
  const CameraParameters& given = odometry.given_camera();
  const CalibrationOptions& options = odometry.options().calibration;
  if (!options.enabled || !IsCalibrated(given.model)) return {};
  const bool is_refined = refinement && refinement->adjustment.covariance.rows() > 0;
  const CameraParameters& camera =
      is_refined ? refinement->adjustment.camera : odometry.camera().parameters();
  Eigen::Vector3d variances = odometry.calibration().covariance.diagonal();
  if (is_refined) variances = refinement->adjustment.covariance.diagonal();
  const Eigen::Vector3d sigmas = variances.cwiseSqrt();
  const Eigen::Vector3d shares = 1 - sigmas.cwiseQuotient(PriorSigmas(options)).array().square();
  CalibrationReport report;
  report.estimates = {{"fx", given.fx, camera.fx, camera.fx * sigmas[0], shares[0]},
                      {"k1", given.k1, camera.k1, sigmas[1], shares[1]},
                      {"k2", given.k2, camera.k2, sigmas[2], shares[2]}};
  report.contradicts_given = odometry.contradicts_given_camera();
  return report;
}

nlohmann::ordered_json ToJson(const CalibrationReport& report) {
  if (report.estimates.empty()) return nullptr;
  nlohmann::ordered_json json = {{"contradicts_given", report.contradicts_given}};
  for (const CalibrationReport::Estimate& e : report.estimates) {
    json[e.name] = {{"given", e.given},
                    {"value", e.value},
                    {"sigma", e.sigma},
                    {"share_from_data", e.share_from_data}};
  }
  return json;
}

std::string ToText(const CalibrationReport& report) {
  if (report.estimates.empty()) return "";
  std::string text = "camera:";
  for (const CalibrationReport::Estimate& e : report.estimates) {
    text += fmt::format(" {} {:.4g} ± {:.2g} (given {:.4g}, {:.0f}% from the pictures)", e.name,
                        e.value, e.sigma, e.given, 100 * e.share_from_data);
  }
  return text + "\n";
}

void WarnOfContradiction(const CalibrationReport& report) {
  if (!report.contradicts_given) return;
  spdlog::warn(
      "the pictures contradict the given camera by more than its standard deviations allow; it was "
      "used as given: check its focal length and distortion, or say how uncertain they are "
      "(calibration.focal_sigma, k1_sigma, k2_sigma)");
}

}  // namespace corvo
