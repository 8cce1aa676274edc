// SPDX-License-Identifier: MIT
#include "bench/quality/charts.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "apps/output/gnuplot.h"

namespace corvo::bench {
namespace {

/// Returns the parameters of a series, ascending.
std::set<double> ParametersOf(const QualityReport& report, const std::string& series) {
  std::set<double> parameters;
  for (const PairResult& result : report.pairs) {
    if (result.series == series) parameters.insert(result.parameter);
  }
  return parameters;
}

/// Returns a named gnuplot data block: in each line a parameter, then the precision of every
/// contender.
std::string DataBlock(const QualityReport& report, const std::string& series, std::size_t number) {
  std::string block = fmt::format("$series{} << EOD\n", number);
  for (const double parameter : ParametersOf(report, series)) {
    block += fmt::format("{}", parameter);
    for (const std::string& contender : report.contenders) {
      block +=
          fmt::format(" {:.4f}", SumOf(report.pairs, contender, series, parameter).Precision());
    }
    block += "\n";
  }
  return block + "EOD\n";
}

std::string Panel(const QualityReport& report, const std::string& series, std::size_t number) {
  std::string panel = fmt::format("set title '{}'\nplot ", series);
  for (std::size_t i = 0; i < report.contenders.size(); ++i) {
    panel += fmt::format("$series{} using 1:{} with linespoints lw 2 lt {} title '{}', ", number,
                         i + 2, i + 1, report.contenders[i]);
  }
  return panel + "\n";
}

}  // namespace

std::string ChartScript(const QualityReport& report, const std::vector<std::string>& series) {
  const std::size_t columns = std::min<std::size_t>(series.size(), 3);
  const std::size_t rows = (series.size() + columns - 1) / columns;
  std::string script = fmt::format(
      "set terminal pngcairo size {},{} font ',9'\nset grid\nset yrange [0:1]\n"
      "set ylabel 'precision'\nset key outside bottom center horizontal\n",
      440 * columns, 380 * rows);
  for (std::size_t i = 0; i < series.size(); ++i) script += DataBlock(report, series[i], i);
  script += fmt::format("set multiplot layout {},{}\n", rows, columns);
  for (std::size_t i = 0; i < series.size(); ++i) script += Panel(report, series[i], i);
  return script + "unset multiplot\n";
}

bool DrawCharts(const QualityReport& report, const std::filesystem::path& folder) {
  const std::string rotation =
      ChartScript(report, {"rotation, sigma 0", "rotation, sigma 10", "rotation, sigma 20"});
  const std::string changes =
      ChartScript(report, {"scale", "blur", "jpeg", "brightness", "contrast", "oxford graf"});
  return RunGnuplot(rotation, folder / "rotation.png") &&
         RunGnuplot(changes, folder / "changes.png");
}

}  // namespace corvo::bench
