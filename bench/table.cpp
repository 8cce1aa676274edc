// SPDX-License-Identifier: MIT
#include "bench/table.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

namespace corvo::bench {
namespace {

/// Returns the first row of an instruction set, or the end if there is none.
std::vector<ComparisonRow>::const_iterator FindInstructionSet(
    const std::vector<ComparisonRow>& rows, const std::string& name) {
  return std::find_if(rows.begin(), rows.end(),
                      [&](const ComparisonRow& row) { return row.instruction_set == name; });
}

std::vector<std::string> DistinctTitles(const std::vector<ComparisonRow>& rows) {
  std::vector<std::string> titles;
  for (const ComparisonRow& row : rows) {
    if (std::find(titles.begin(), titles.end(), row.title) == titles.end()) {
      titles.push_back(row.title);
    }
  }
  return titles;
}

std::string Head(const std::vector<std::string>& fixed, const std::vector<std::string>& more) {
  std::string names = "|";
  std::string rule = "|";
  for (const auto* columns : {&fixed, &more}) {
    for (const std::string& name : *columns) {
      names += fmt::format(" {} |", name);
      rule += "---|";
    }
  }
  return names + "\n" + rule + "\n";
}

/// Returns the table line of one title, whose rows are `rows`.
std::string Line(const std::vector<ComparisonRow>& rows,
                 const std::vector<std::string>& instruction_sets) {
  const ComparisonRow& first = rows.front();
  std::string line =
      fmt::format("| {} | {} | {:.3g} | {:.2f} | {:.3g} |", first.title, first.images, first.ms,
                  first.p99_ms / first.ms, first.baseline_ms);
  for (const std::string& name : instruction_sets) {
    const auto row = FindInstructionSet(rows, name);
    line += row == rows.end() ? " |" : fmt::format(" {:.2f}x |", row->ratio);
  }
  return line + "\n";
}

}  // namespace

std::string ComparisonTable(const std::vector<ComparisonRow>& rows,
                            const std::vector<std::string>& instruction_sets) {
  std::vector<std::string> columns;
  std::copy_if(instruction_sets.begin(), instruction_sets.end(), std::back_inserter(columns),
               [&](const auto& name) { return FindInstructionSet(rows, name) != rows.end(); });
  std::string table = Head({"comparison", "images", "ms", "p99 / p50", "baseline ms"}, columns);
  for (const std::string& title : DistinctTitles(rows)) {
    std::vector<ComparisonRow> of_title;
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(of_title),
                 [&](const ComparisonRow& row) { return row.title == title; });
    table += Line(of_title, columns);
  }
  return table;
}

std::string StageTable(const std::vector<StageRow>& rows, const std::vector<std::string>& stages) {
  std::string table = Head({"stages, ms", "images"}, stages);
  for (const StageRow& row : rows) {
    table += fmt::format("| {} | {} |", row.title, row.images);
    for (const double ms : row.ms) table += fmt::format(" {:.3g} |", ms);
    table += "\n";
  }
  return table;
}

}  // namespace corvo::bench
