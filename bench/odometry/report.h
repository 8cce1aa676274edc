// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/odometry/perturbation.h"
#include "bench/odometry/trial.h"

namespace corvo::bench {

/// A scenario under one perturbation.
struct Trial {
  std::string scenario;
  Perturbation perturbation;
  TrialResult result;
};

/// A Markdown table with a line for each scenario, in order of appearance: medians over the judged
/// perturbations and, in brackets, the worst.
std::string SummaryTable(const std::vector<Trial>& trials);

/// A Markdown table with a line for each trial.
std::string TrialTable(const std::vector<Trial>& trials);

/// Every figure of every trial; null where it cannot be said.
nlohmann::ordered_json ToJson(const std::vector<Trial>& trials);

}  // namespace corvo::bench
