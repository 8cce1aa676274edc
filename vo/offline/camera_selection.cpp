#include "vo/offline/camera_selection.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "vo/camera/camera_fit.h"
#include "vo/core/conventions.h"

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

std::vector<FreeParameter> DistortionOf(CalibrationModel model) {
  constexpr double kRadialSigma = 0.3, kTangentialSigma = 0.01, kOmegaSigma = 1;
  switch (model) {
    case CalibrationModel::kPinhole:
      break;
    case CalibrationModel::kRadtan:
      return {{"k1", kRadialSigma},
              {"k2", kRadialSigma},
              {"p1", kTangentialSigma},
              {"p2", kTangentialSigma}};
    case CalibrationModel::kKb4:
      return {
          {"k1", kRadialSigma}, {"k2", kRadialSigma}, {"k3", kRadialSigma}, {"k4", kRadialSigma}};
    case CalibrationModel::kFov:
      return {{"omega", kOmegaSigma}};
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

CameraPrior PriorOf(CalibrationModel model, const Camera& start) {
  const double center_sigma = 0.02 * start.width();
  CameraPrior prior{FitCamera(start, ModelOf(model)),
                    {{"focal"}, {"cx", center_sigma}, {"cy", center_sigma}}};
  if (model == CalibrationModel::kPinhole)
    prior.given = WithoutDistortion(prior.given, CameraModel::kPinhole);
  prior.given.cx = 0.5 * (start.width() - 1);
  prior.given.cy = 0.5 * (start.height() - 1);
  for (const FreeParameter& parameter : DistortionOf(model)) prior.free.push_back(parameter);
  return prior;
}

CameraCandidate AdjustCandidate(CalibrationModel model, const Camera& start,
                                const std::vector<Bundle>& bundles,
                                const AdjustmentProgress& progress) {
  CameraCandidate candidate{model, PriorOf(model, start), {}, bundles, 0};
  candidate.adjustment =
      BundleAdjuster({.num_rounds = 2})
          .Adjust(candidate.prior, candidate.prior.given, candidate.bundles, progress);
  candidate.information_criterion = InformationCriterion(candidate.prior, candidate.adjustment);
  return candidate;
}

int SelectCandidate(const std::vector<CameraCandidate>& candidates) {
  constexpr double kVeryStrongEvidence = 10;
  double lowest = std::numeric_limits<double>::infinity();
  for (const CameraCandidate& candidate : candidates) {
    lowest = std::min(lowest, candidate.information_criterion);
  }
  int selected = kNoId;
  for (int i = 0; i < static_cast<int>(candidates.size()) && std::isfinite(lowest); ++i) {
    if (candidates[i].information_criterion > lowest + kVeryStrongEvidence) continue;
    const bool is_simpler =
        selected == kNoId || candidates[i].prior.num_free() < candidates[selected].prior.num_free();
    if (is_simpler) selected = i;
  }
  return selected;
}

}  // namespace corvo
