// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include <nlohmann/json.hpp>

#include "vo/offline/refiner.h"

namespace corvo {

/// The figures of a refinement.
struct RefinementReport {
  std::string why_not;  ///< Why the trajectory was not refined; empty if it was.
  double cost_before = 0;
  double cost_after = 0;  ///< Valid only if the trajectory was refined.
  int num_observations = 0;
  int num_inliers = 0;
  int num_adjusted = 0;
  int num_placed = 0;
  int num_moved = 0;
};

RefinementReport ReportRefinement(const Refinement& refinement);

nlohmann::ordered_json ToJson(const RefinementReport& report);

/// Returns one line.
std::string ToText(const RefinementReport& report);

}  // namespace corvo
