// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <benchmark/benchmark.h>

#include "bench/table.h"

namespace corvo::bench {

/// A reporter that prints progress to the error stream and finally the tables of all runs.
class TableReporter : public benchmark::BenchmarkReporter {
 public:
  bool ReportContext(const Context& context) override;
  void ReportRuns(const std::vector<Run>& runs) override;
  void Finalize() override;

 private:
  std::vector<ComparisonRow> comparisons_;
  std::vector<StageRow> stages_;
};

}  // namespace corvo::bench
