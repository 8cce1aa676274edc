// SPDX-License-Identifier: MIT
#pragma once

#include <limits>
#include <vector>

namespace corvo::bench {

/// The least times of a number of items.
class LeastTimes {
 public:
  explicit LeastTimes(int items) : ms_(items, std::numeric_limits<double>::infinity()) {}

  void Add(int item, double ms);

  /// Returns the least time of each item, infinity if it has none.
  const std::vector<double>& ms() const { return ms_; }

 private:
  std::vector<double> ms_;
};

/// Statistics of a contender and a baseline that were timed on the same items.
struct PairedSummary {
  double ms = 0;               ///< The contender's median over items.
  double p99_ms = 0;           ///< The contender's 99th percentile.
  double baseline_ms = 0;      ///< The baseline's median.
  double baseline_p99_ms = 0;  ///< The baseline's 99th percentile.
  double ratio = 0;            ///< Median of the items' ratios, baseline over contender.
  double ratio_p10 = 0;        ///< 10th percentile of the items' ratios.
  double ratio_p90 = 0;        ///< 90th percentile of the items' ratios.
};

/// Computes the statistics. There is at least one item, and every item has both times.
PairedSummary Summarize(const LeastTimes& contender, const LeastTimes& baseline);

}  // namespace corvo::bench
