// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "vo/map/map.h"

namespace corvo {

/// A parameter for which the map fits another value than that of its camera.
struct MisfittingParameter {
  std::string name;  ///< As in FreeParameter.
  double used = 0;   ///< The value in the map's camera; that of fx for "focal".
  double fitted = 0;
  double sigma = 0;  ///< Standard deviation of `fitted`.
};

/// Options of FindMisfittingParameters(). The standard deviations are those of the prior: what a
/// calibration may be wrong by.
struct ParameterCheckOptions {
  int min_keyframes = 8;
  double focal_sigma = 0.03;
  double center_sigma_share = 0.015;  ///< As a share of the width.
  double radial_sigma = 0.05;         ///< Of k1, k2 and omega.
  double tangential_sigma = 0.005;
  double min_sigmas = 4;   ///< Smallest difference, in standard deviations of the fitted value, and
  double min_share = 0.3;  ///< as a share of the prior's standard deviation.
};

/// Estimates the parameters of the map's camera that are not usually estimated while tracking, the
/// principal point and the tangential distortion among them, from all active keyframes. Returns
/// those that differ clearly from what the map was made with, by descending significance: the
/// calibration is wrong there. Most motions tell little of these parameters, so that an empty list
/// does not mean that they are right. Empty if the keyframes are too few.
std::vector<MisfittingParameter> FindMisfittingParameters(
    const Map& map, const ParameterCheckOptions& options = {});

}  // namespace corvo
