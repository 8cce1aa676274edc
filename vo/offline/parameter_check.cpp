// SPDX-License-Identifier: MIT
#include "vo/offline/parameter_check.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "vo/core/options.h"
#include "vo/offline/map_camera.h"

namespace corvo {
namespace {

CameraPrior PriorAround(const CameraParameters& camera, const ParameterCheckOptions& options) {
  const double center_sigma = options.center_sigma_share * camera.width;
  CameraPrior prior{camera,
                    {{"focal", options.focal_sigma},
                     {"cx", center_sigma},
                     {"cy", center_sigma},
                     {"k1", options.radial_sigma},
                     {"k2", options.radial_sigma},
                     {"omega", options.radial_sigma},
                     {"p1", options.tangential_sigma},
                     {"p2", options.tangential_sigma}}};
  std::erase_if(prior.free, [&camera](const FreeParameter& parameter) {
    return !HasParameter(camera.model, parameter.name);
  });
  return prior;
}

/// The fitted value of a parameter, and how far it is from the one used, in its standard
/// deviations.
struct Fit {
  MisfittingParameter parameter;
  double num_sigmas = 0;
};

Fit FitOf(const CameraPrior& prior, const AdjustmentSummary& adjusted, int i) {
  const double sigma = std::sqrt(adjusted.estimate.covariance(i, i));
  const std::string& name = prior.free[i].name;
  Fit fit;
  fit.num_sigmas = std::abs(adjusted.estimate.difference[i]) / sigma;
  fit.parameter = {name, ValueOf(prior.given, name), ValueOf(adjusted.camera, name),
                   name == "focal" ? sigma * prior.given.fx : sigma};
  return fit;
}

}  // namespace

std::vector<MisfittingParameter> FindMisfittingParameters(const Map& map,
                                                          const ParameterCheckOptions& options) {
  const std::vector<KeyframeGroup> groups = SplitKeyframes(map, 1, options.min_keyframes);
  if (groups.empty()) return {};
  const CameraPrior prior = PriorAround(map.camera().parameters(), options);
  const CalibrationOptions stated;
  const AdjustmentSummary adjusted =
      AdjustMapCamera(map, groups, prior, stated.information_factor * stated.stated_share);
  if (!adjusted.is_usable()) return {};
  std::vector<Fit> fits;
  for (int i = 0; i < prior.num_free(); ++i) {
    const Fit fit = FitOf(prior, adjusted, i);
    const double share = std::abs(adjusted.estimate.difference[i]) / prior.free[i].sigma;
    if (fit.num_sigmas >= options.min_sigmas && share >= options.min_share) fits.push_back(fit);
  }
  std::ranges::sort(fits, std::ranges::greater(), &Fit::num_sigmas);
  std::vector<MisfittingParameter> misfitting;
  for (const Fit& fit : fits) misfitting.push_back(fit.parameter);
  return misfitting;
}

}  // namespace corvo
