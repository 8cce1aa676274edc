// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "bench/quality/contenders.h"
#include "bench/quality/protocols.h"

namespace corvo::bench {

/// What a contender achieves on one pair.
struct PairResult {
  std::string contender;
  std::string series;
  std::string image;
  double parameter = 0;
  Measures measures;
};

/// Describes both images of every task and measures the pair.
std::vector<PairResult> RunTasks(const Contender& contender, const std::vector<PairTask>& tasks,
                                 int num_features);

/// Sum over the pairs of a contender in a series, or with `parameter` only those with it.
Measures SumOf(const std::vector<PairResult>& results, const std::string& contender,
               const std::string& series);
Measures SumOf(const std::vector<PairResult>& results, const std::string& contender,
               const std::string& series, double parameter);

}  // namespace corvo::bench
