// SPDX-License-Identifier: MIT
#include "vo/offline/camera_selection.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vo/camera/camera_fit.h"
#include "vo/core/conventions.h"
#include "vo/core/option_fields.h"

namespace corvo {
namespace {

CameraModel ModelOf(CalibrationModel model) {
  switch (model) {
    case CalibrationModel::kKb4:
      return CameraModel::kKb4;
    case CalibrationModel::kFov:
      return CameraModel::kFov;
    case CalibrationModel::kPinhole:
    case CalibrationModel::kRadtan:
      break;
  }
  return CameraModel::kPinhole;
}

std::vector<FreeParameter> DistortionOf(CalibrationModel model, const CandidateOptions& options) {
  const double radial = options.radial_sigma;
  const double tangential = options.tangential_sigma;
  switch (model) {
    case CalibrationModel::kPinhole:
      break;
    case CalibrationModel::kRadtan:
      return {{"k1", radial}, {"k2", radial}, {"p1", tangential}, {"p2", tangential}};
    case CalibrationModel::kKb4:
      return {{"k1", radial}, {"k2", radial}, {"k3", radial}, {"k4", radial}};
    case CalibrationModel::kFov:
      return {{"omega", options.omega_sigma}};
  }
  return {};
}

double InformationCriterion(const CameraPrior& prior, const AdjustmentSummary& adjustment) {
  if (!adjustment.is_usable()) {
    return std::numeric_limits<double>::infinity();
  }
  return prior.num_free() * std::log(2.0 * adjustment.num_observations) + 2 * adjustment.final_cost;
}

}  // namespace

std::string_view ToString(CalibrationModel model) {
  switch (model) {
    case CalibrationModel::kPinhole:
      return "pinhole";
    case CalibrationModel::kRadtan:
      return "radtan";
    case CalibrationModel::kKb4:
      return "kb4";
    case CalibrationModel::kFov:
      return "fov";
  }
  return "";
}

std::vector<CalibrationModel> AllCalibrationModels() {
  return {CalibrationModel::kPinhole, CalibrationModel::kFov, CalibrationModel::kRadtan,
          CalibrationModel::kKb4};
}

void CandidateOptions::Validate() const { CheckFields("camera_candidate", *this); }

CameraPrior PriorOf(CalibrationModel model, const Camera& start, const CandidateOptions& options) {
  const double center_sigma = options.center_sigma_share * start.width();
  CameraPrior prior{FitCamera(start, ModelOf(model)),
                    {{"focal"}, {"cx", center_sigma}, {"cy", center_sigma}}};
  if (model == CalibrationModel::kPinhole)
    prior.given = WithoutDistortion(prior.given, CameraModel::kPinhole);
  prior.given.cx = 0.5 * (start.width() - 1);
  prior.given.cy = 0.5 * (start.height() - 1);
  for (const FreeParameter& parameter : DistortionOf(model, options))
    prior.free.push_back(parameter);
  return prior;
}

CameraCandidate AdjustCandidate(CalibrationModel model, const Camera& start,
                                const std::vector<Bundle>& bundles, const CandidateOptions& options,
                                const AdjustmentProgress& progress) {
  options.Validate();
  CameraCandidate candidate{model, PriorOf(model, start, options), {}, bundles, 0};
  candidate.adjustment =
      BundleAdjuster({.num_rounds = options.num_rounds})
          .Adjust(candidate.prior, candidate.prior.given, candidate.bundles, progress);
  candidate.information_criterion = InformationCriterion(candidate.prior, candidate.adjustment);
  return candidate;
}

int SelectCandidate(const std::vector<CameraCandidate>& candidates,
                    const CandidateOptions& options) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const CameraCandidate& candidate : candidates) {
    lowest = std::min(lowest, candidate.information_criterion);
  }
  int selected = kNoId;
  for (int i = 0; i < static_cast<int>(candidates.size()) && std::isfinite(lowest); ++i) {
    if (candidates[i].information_criterion > lowest + options.max_excess) continue;
    const bool is_simpler =
        selected == kNoId || candidates[i].prior.num_free() < candidates[selected].prior.num_free();
    if (is_simpler) selected = i;
  }
  return selected;
}

}  // namespace corvo
