// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <vector>

namespace corvo::bench {

/// The least time that each of a number of items took.
class LeastTimes {
 public:
  explicit LeastTimes(int items) : ms_(items, std::numeric_limits<double>::infinity()) {}

  void Add(int item, double ms);

  /// Item by item; infinite where there is none.
  const std::vector<double>& ms() const { return ms_; }

 private:
  std::vector<double> ms_;
};

/// A contender against a baseline, both timed on the same items.
struct PairedSummary {
  double ms = 0;               ///< The contender's median over items.
  double p99_ms = 0;           ///< The contender's 99th percentile.
  double baseline_ms = 0;      ///< The baseline's median.
  double baseline_p99_ms = 0;  ///< The baseline's 99th percentile.
  double ratio = 0;            ///< Median of the items' ratios, baseline over contender.
  double ratio_p10 = 0;        ///< 10th percentile of these.
  double ratio_p90 = 0;        ///< 90th percentile of these.
};

/// There is at least one item, and every one has both times.
PairedSummary Summarize(const LeastTimes& contender, const LeastTimes& baseline);

}  // namespace corvo::bench
