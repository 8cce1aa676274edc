// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/odometry/trial.h"

namespace corvo::bench {

/// The result of a scenario from one image on.
struct Trial {
  std::string scenario;
  int start = 0;  ///< Index of the first image.
  TrialResult result;
};

/// Returns a Markdown table with a line for each scenario, in order of appearance: the medians
/// over the starts and, in brackets, the worst values.
std::string SummaryTable(const std::vector<Trial>& trials);

/// Returns a Markdown table with a line for each trial.
std::string TrialTable(const std::vector<Trial>& trials);

/// Returns every figure of every trial; unknown figures are null.
nlohmann::ordered_json ToJson(const std::vector<Trial>& trials);

}  // namespace corvo::bench
