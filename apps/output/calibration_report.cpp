// SPDX-License-Identifier: MIT
#include "apps/output/calibration_report.h"

#include <fmt/format.h>

namespace corvo {

namespace {

CalibrationReport::Estimate ReportParameter(const FreeParameter& parameter,
                                            const CameraParameters& given,
                                            const CameraParameters& camera, double sigma) {
  CalibrationReport::Estimate estimate{parameter.name, ValueOf(given, parameter.name),
                                       ValueOf(camera, parameter.name), sigma,
                                       InformationGain(parameter, sigma)};
  estimate.is_contradicted = parameter.needs_evidence && estimate.value != estimate.given;
  if (parameter.name == "focal") {  // Reported as fx, in px.
    estimate.name = "fx";
    estimate.sigma *= camera.fx;
  }
  return estimate;
}

}  // namespace

CalibrationReport ReportCalibration(const Odometry& odometry,
                                    const std::optional<Refinement>& refinement) {
  const CameraPrior& prior = odometry.camera_prior();
  const bool is_refined = refinement && refinement->adjustment.estimate.covariance.rows() > 0;
  CalibrationReport report;
  report.prior_rejected = odometry.prior_rejected();
  report.is_consistent = odometry.camera_estimate().is_consistent;
  report.camera = is_refined ? refinement->adjustment.camera : odometry.camera().parameters();
  report.sigma = Posterior(prior.free, is_refined ? refinement->adjustment.estimate.covariance
                                                  : odometry.camera_estimate().covariance);
  for (int i = 0; i < prior.num_free(); ++i) {
    report.estimates.push_back(
        ReportParameter(prior.free[i], prior.given, report.camera, report.sigma[i].sigma));
  }
  return report;
}

nlohmann::ordered_json ToJson(const CalibrationReport& report) {
  if (report.estimates.empty()) return nullptr;
  nlohmann::ordered_json json = {{"prior_rejected", report.prior_rejected},
                                 {"consistent", report.is_consistent}};
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
    text += fmt::format(" {} {:.4g} ± {:.2g} (given {:.4g}, {:.0f}% from the images)", e.name,
                        e.value, e.sigma, e.given, 100 * e.share_from_data);
  }
  return text + "\n";
}

}  // namespace corvo
