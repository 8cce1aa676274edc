// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "bench/quality/contenders.h"
#include "bench/quality/protocols.h"

namespace corvo::bench {

/// The result of a contender on one pair of images.
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

/// Returns the sum over the pairs of a contender in a series; with `parameter`, only over the pairs
/// with that parameter.
Measures SumOf(const std::vector<PairResult>& results, const std::string& contender,
               const std::string& series);
Measures SumOf(const std::vector<PairResult>& results, const std::string& contender,
               const std::string& series, double parameter);

}  // namespace corvo::bench
