// SPDX-License-Identifier: MIT
#include "bench/table_reporter.h"

#include <ostream>
#include <string>

#include "bench/staged_extractor.h"
#include "orb/kernels/instruction_sets.h"

namespace corvo::bench {
namespace {

/// The parts of a run's name "title/instruction_set".
struct RunName {
  std::string title;
  std::string instruction_set;
};

RunName Split(const std::string& name) {
  const std::size_t slash = name.rfind('/');
  return {name.substr(0, slash), name.substr(slash + 1)};
}

ComparisonRow ToComparison(const benchmark::BenchmarkReporter::Run& run) {
  const RunName name = Split(run.run_name.function_name);
  ComparisonRow row;
  row.title = name.title;
  row.images = run.report_label;
  row.instruction_set = name.instruction_set;
  row.ms = run.counters.at("ms");
  row.p99_ms = run.counters.at("p99_ms");
  row.baseline_ms = run.counters.at("baseline_ms");
  row.ratio = run.counters.at("ratio");
  return row;
}

StageRow ToStages(const benchmark::BenchmarkReporter::Run& run) {
  StageRow row = {Split(run.run_name.function_name).title, run.report_label, {}};
  for (const char* stage : kStages) row.ms.push_back(run.counters.at(stage));
  return row;
}

}  // namespace

bool TableReporter::ReportContext(const Context& /*context*/) { return true; }

void TableReporter::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    if (run.run_type != Run::RT_Iteration) continue;
    if (run.counters.count("ratio") > 0) {
      comparisons_.push_back(ToComparison(run));
    } else {
      stages_.push_back(ToStages(run));
    }
    GetErrorStream() << run.run_name.function_name << " done" << std::endl;
  }
}

void TableReporter::Finalize() {
  std::ostream& stream = GetOutputStream();
  if (!comparisons_.empty()) {
    stream << ComparisonTable(comparisons_, orb::kernels::InstructionSets()) << "\n";
  }
  if (!stages_.empty()) stream << StageTable(stages_, {kStages.begin(), kStages.end()}) << "\n";
  stream.flush();
}

}  // namespace corvo::bench
