// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "bench/quality/report.h"

namespace corvo::bench {

/// Returns a gnuplot script that prints a PNG of the precision over the parameter, with one panel
/// for each of `series` and one line for each contender.
std::string ChartScript(const QualityReport& report, const std::vector<std::string>& series);

/// Writes rotation.png and changes.png into the folder. Returns false if gnuplot is missing or
/// fails.
bool DrawCharts(const QualityReport& report, const std::filesystem::path& folder);

}  // namespace corvo::bench
