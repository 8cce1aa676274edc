// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "bench/quality/report.h"

namespace corvo::bench {

/// A gnuplot script that prints a PNG of precision over the parameter of each of `series`, a panel
/// each, a line for each contender.
std::string ChartScript(const QualityReport& report, const std::vector<std::string>& series);

/// Writes rotation.png and changes.png into the folder. False where gnuplot is missing or fails.
bool DrawCharts(const QualityReport& report, const std::filesystem::path& folder);

}  // namespace corvo::bench
