// SPDX-License-Identifier: MIT
#include "vo/offline/calibration_check.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "vo/math/median.h"

namespace corvo {
namespace {

/// The difference of a part's focal length from the map's, as a logarithm.
struct PartFocal {
  double difference = 0;
  double sigma = 0;
};

/// Returns the prior of a given camera, but with a focal length that is nearly unknown.
CameraPrior WidePrior(const CameraParameters& camera, const CalibrationCheckOptions& options) {
  CalibrationOptions given;
  given.focal_sigma = options.focal_sigma;
  CameraPrior prior = MakePrior(camera, given);
  std::erase_if(prior.free, &FreeParameter::needs_evidence);
  return prior;
}

std::vector<PartFocal> EstimateParts(const Map& map, const CalibrationCheckOptions& options) {
  const CameraPrior prior = WidePrior(map.camera().parameters(), options);
  std::vector<PartFocal> parts;
  for (const KeyframeGroup& group : SplitKeyframes(map, options.num_parts, options.min_keyframes)) {
    const AdjustmentSummary adjusted = AdjustMapCamera(map, {group}, prior);
    if (!adjusted.is_usable()) continue;
    const CameraEstimate& estimate = adjusted.estimate;
    parts.push_back({estimate.difference[0], std::sqrt(estimate.covariance(0, 0))});
  }
  return parts;
}

/// Returns the parts that fit another focal length and agree with the median.
std::vector<PartFocal> AgreeingParts(const std::vector<PartFocal>& parts, double median,
                                     const CalibrationCheckOptions& options) {
  std::vector<PartFocal> agreeing;
  for (const PartFocal& part : parts) {
    const bool differs = std::abs(part.difference) >= options.min_difference;
    const double apart = std::abs(part.difference - median);
    if (differs && apart <= options.max_disagreement * std::abs(median)) agreeing.push_back(part);
  }
  return agreeing;
}

/// Returns the weighted mean of the differences, in its standard deviations. No part alone counts
/// more than `max_part_sigmas` of its own.
double PooledSigmas(const std::vector<PartFocal>& parts, const CalibrationCheckOptions& options) {
  double information = 0, sum = 0;
  for (const PartFocal& part : parts) {
    const double sigma = std::max(part.sigma, std::abs(part.difference) / options.max_part_sigmas);
    information += 1 / (sigma * sigma);
    sum += part.difference / (sigma * sigma);
  }
  return std::abs(sum) / std::sqrt(information);
}

}  // namespace

CalibrationCheck CheckCalibration(const Map& map, const CalibrationCheckOptions& options) {
  const std::vector<PartFocal> parts = EstimateParts(map, options);
  if (parts.empty()) return {};
  std::vector<double> differences;
  for (const PartFocal& part : parts) differences.push_back(part.difference);
  const double median = Median(differences);
  const std::vector<PartFocal> agreeing = AgreeingParts(parts, median, options);
  CalibrationCheck check;
  check.num_parts = static_cast<int>(parts.size());
  check.num_agreeing = static_cast<int>(agreeing.size());
  check.focal_px = map.camera().fx() * std::exp(median);
  check.is_implausible = std::abs(median) >= options.min_median && check.num_agreeing >= 2 &&
                         2 * check.num_agreeing >= check.num_parts &&
                         PooledSigmas(agreeing, options) >= options.min_sigmas;
  return check;
}

void WidenFocalLength(const CalibrationCheck& check, const CameraPrior& prior, double fx,
                      PoseGraph& graph) {
  if (!check.is_implausible) return;
  const double difference = std::log(check.focal_px / fx);
  for (int i = 0; i < prior.num_free() && i < graph.camera_covariance.rows(); ++i) {
    if (prior.free[i].name != "focal") continue;
    double& variance = graph.camera_covariance(i, i);
    variance = std::max(variance, difference * difference);
  }
}

}  // namespace corvo
