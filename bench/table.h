// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

namespace corvo::bench {

/// What a comparison gave on one instruction set.
struct ComparisonRow {
  std::string title;
  std::string images;
  std::string instruction_set;
  double ms = 0;           ///< The contender's median.
  double p99_ms = 0;       ///< Its 99th percentile.
  double baseline_ms = 0;  ///< The baseline's median.
  double ratio = 0;        ///< Median of the paired ratios.
};

/// A Markdown table: a line for each title, in order of appearance, with the times on the
/// instruction set that it came with first, and a column of ratios for each of `instruction_sets`
/// that there are rows of.
std::string ComparisonTable(const std::vector<ComparisonRow>& rows,
                            const std::vector<std::string>& instruction_sets);

/// What the stages of a task took.
struct StageRow {
  std::string title;
  std::string images;
  std::vector<double> ms;  ///< Of each stage.
};

/// A Markdown table: a line for each row, a column for each of `stages`.
std::string StageTable(const std::vector<StageRow>& rows, const std::vector<std::string>& stages);

}  // namespace corvo::bench
