// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/quality/runner.h"
#include "bench/quality/scale_bias.h"

namespace corvo::bench {

/// The properties of a contender's keypoints that do not depend on matching.
struct KeypointResult {
  std::string contender;
  std::vector<double> spread;    ///< Mean spread in each of the folders.
  std::vector<OctaveBias> bias;  ///< Bias of each octave over all images.

  /// Returns the largest bias of the octaves with at least 50 pairs, px.
  double MaxBiasPx() const;
};

struct QualityReport {
  std::vector<std::string> contenders;      ///< Names in the order of the columns.
  std::vector<std::string> spread_folders;  ///< In the order of KeypointResult::spread.
  std::vector<PairResult> pairs;
  std::vector<KeypointResult> keypoints;
};

/// Returns a Markdown table with a line for each measure and series and a column for each
/// contender. Shares are computed from sums over a series' pairs; correct matches are sums for
/// Oxford's sequences, else means.
std::string QualityTable(const QualityReport& report);

/// Returns a Markdown table of the requirements for corvo's features and the values reached.
std::string RequirementTable(const QualityReport& report);

/// Returns the counts of every pair and the keypoint results of every contender.
nlohmann::ordered_json ToJson(const QualityReport& report);

}  // namespace corvo::bench
