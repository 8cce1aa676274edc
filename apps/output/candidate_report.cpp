// SPDX-License-Identifier: MIT
#include "apps/output/candidate_report.h"

#include <fmt/format.h>

#include "vo/offline/self_calibration.h"

namespace corvo {
namespace {

bool IsDistortion(const std::string& name) {
  return name != "focal" && name != "cx" && name != "cy";
}

}  // namespace

std::string CandidatesText(const std::vector<CameraCandidate>& candidates, int selected) {
  std::string text = fmt::format("  {:<8} {:>10} {:>8} {:>12} {:>12}\n", "model", "parameters",
                                 "rms, px", "cost", "criterion");
  for (int i = 0; i < static_cast<int>(candidates.size()); ++i) {
    const CameraCandidate& candidate = candidates[i];
    text += fmt::format("{} {:<8} {:>10} ", i == selected ? '*' : ' ', ToString(candidate.model),
                        candidate.prior.num_free());
    if (candidate.adjustment.is_usable()) {
      text += fmt::format("{:>8.3f} {:>12.1f} {:>12.1f}\n", candidate.adjustment.inlier_rms_px,
                          candidate.adjustment.final_cost, candidate.information_criterion);
    } else {
      text += "not estimated\n";
    }
  }
  return text;
}

std::string EstimateText(const CameraCandidate& candidate) {
  const std::vector<FreeParameter> sigma = EstimatedSigmas(candidate);
  const Eigen::MatrixXd& covariance = candidate.adjustment.estimate.covariance;
  std::string text = "  parameter        value        sigma  correlations\n";
  for (std::size_t i = 0; i < sigma.size(); ++i) {
    const std::string& name = sigma[i].name;
    const double deviation = sigma[i].sigma;
    const double value = ValueOf(candidate.adjustment.camera, name);
    const double in_unit = name == "focal" ? deviation * value : deviation;
    text += fmt::format("  {:<9} {:>12.6g} {:>12.3g} ", name, value, in_unit);
    for (std::size_t j = 0; j < i; ++j) {
      const double correlation = covariance(i, j) / (sigma[i].sigma * sigma[j].sigma);
      text += fmt::format(" {} {:+.2f}", sigma[j].name, correlation);
    }
    text += "\n";
  }
  return text;
}

std::vector<std::string> UndeterminedWarnings(const CameraCandidate& candidate) {
  constexpr double kMaxFocalSigma = 0.01;
  constexpr double kMinShare = 0.5;
  std::vector<std::string> warnings;
  bool is_center_determined = true, is_distortion_determined = true;
  const std::vector<FreeParameter> sigma = EstimatedSigmas(candidate);
  for (std::size_t i = 0; i < sigma.size(); ++i) {
    const FreeParameter& parameter = candidate.prior.free[i];
    const bool is_reported = InformationGain(parameter, sigma[i].sigma) >= kMinShare;
    if (parameter.name == "focal" && !(sigma[i].sigma <= kMaxFocalSigma)) {
      warnings.push_back(fmt::format(
          "the motion does not determine the focal length (standard deviation {:.1f}%): turn while "
          "moving among near and far objects, not straight ahead and not in front of a wall",
          100 * sigma[i].sigma));
    }
    if (parameter.name == "cx" || parameter.name == "cy") is_center_determined &= is_reported;
    if (IsDistortion(parameter.name)) is_distortion_determined &= is_reported;
  }
  if (!is_center_determined) {
    warnings.emplace_back(
        "the motion does not determine the principal point, which stays near the image center: "
        "turn up, down and to the sides, and roll the camera about its optical axis");
  }
  if (!is_distortion_determined) {
    warnings.emplace_back(
        "the motion does not determine all distortion parameters: turn while moving, with texture "
        "up to the image corners");
  }
  return warnings;
}

}  // namespace corvo
