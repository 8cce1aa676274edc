// SPDX-License-Identifier: MIT
#include "bench/paired_times.h"

#include <algorithm>
#include <cstddef>

#include "vo/math/percentile.h"

namespace corvo::bench {

void LeastTimes::Add(int item, double ms) { ms_[item] = std::min(ms_[item], ms); }

PairedSummary Summarize(const LeastTimes& contender, const LeastTimes& baseline) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < contender.ms().size(); ++i) {
    ratios.push_back(baseline.ms()[i] / contender.ms()[i]);
  }
  PairedSummary summary;
  summary.ms = Percentile(contender.ms(), 50);
  summary.p99_ms = Percentile(contender.ms(), 99);
  summary.baseline_ms = Percentile(baseline.ms(), 50);
  summary.baseline_p99_ms = Percentile(baseline.ms(), 99);
  summary.ratio = Percentile(ratios, 50);
  summary.ratio_p10 = Percentile(ratios, 10);
  summary.ratio_p90 = Percentile(ratios, 90);
  return summary;
}

}  // namespace corvo::bench
