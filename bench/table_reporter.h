// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include <benchmark/benchmark.h>

#include "bench/table.h"

namespace corvo::bench {

/// Prints to the error stream what is done, and at the end the tables of all of it.
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
