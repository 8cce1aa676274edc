// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace corvo::bench {

/// The result of a comparison on one instruction set.
struct ComparisonRow {
  std::string title;
  std::string images;
  std::string instruction_set;
  double ms = 0;           ///< The contender's median.
  double p99_ms = 0;       ///< The contender's 99th percentile.
  double baseline_ms = 0;  ///< The baseline's median.
  double ratio = 0;        ///< Median of the paired ratios.
};

/// Returns a Markdown table with a line for each title, in order of appearance: the times on the
/// first instruction set of the title, and a column of ratios for each of `instruction_sets` that
/// has rows.
std::string ComparisonTable(const std::vector<ComparisonRow>& rows,
                            const std::vector<std::string>& instruction_sets);

/// The times of the stages of a task.
struct StageRow {
  std::string title;
  std::string images;
  std::vector<double> ms;  ///< Time of each stage.
};

/// Returns a Markdown table with a line for each row and a column for each of `stages`.
std::string StageTable(const std::vector<StageRow>& rows, const std::vector<std::string>& stages);

}  // namespace corvo::bench
