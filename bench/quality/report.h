// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/quality/runner.h"
#include "bench/quality/scale_bias.h"

namespace corvo::bench {

/// What a contender's keypoints are like, whatever they are matched with.
struct KeypointResult {
  std::string contender;
  std::vector<double> spread;    ///< Of each of the folders, on average.
  std::vector<OctaveBias> bias;  ///< Over all images.

  /// The greatest of octaves with at least 50 pairs, px.
  double MaxBiasPx() const;
};

struct QualityReport {
  std::vector<std::string> contenders;      ///< In order.
  std::vector<std::string> spread_folders;  ///< As KeypointResult::spread.
  std::vector<PairResult> pairs;
  std::vector<KeypointResult> keypoints;
};

/// One Markdown table: for each measure a line for each series, a column for each contender. Shares
/// are those of sums over the series' pairs; correct matches are sums for Oxford's, else means.
std::string QualityTable(const QualityReport& report);

/// A Markdown table of what is required of corvo's features, and what they reach.
std::string RequirementTable(const QualityReport& report);

/// Every pair, and what the tables are made of.
nlohmann::ordered_json ToJson(const QualityReport& report);

}  // namespace corvo::bench
