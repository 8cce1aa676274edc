// SPDX-License-Identifier: MIT
#include "bench/odometry/report.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "vo/math/percentile.h"

namespace corvo::bench {
namespace {

using Figure = double TrialResult::*;

/// Returns a figure of each result. NaN becomes the largest double, so that it counts as the worst.
std::vector<double> Errors(const std::vector<const TrialResult*>& results, Figure figure) {
  std::vector<double> errors;
  for (const TrialResult* result : results) {
    const double error = result->*figure;
    errors.push_back(std::isnan(error) ? std::numeric_limits<double>::max() : error);
  }
  return errors;
}

std::string Format(double error, int digits) {
  const bool is_known = std::isfinite(error) && error < 1e300;
  return is_known ? fmt::format("{:.{}f}", error, digits) : "-";
}

/// Formats the median and the worst error, or `-` if both are unknown.
std::string Spread(const std::vector<double>& errors, int digits) {
  const std::string median = Format(Percentile(errors, 50), digits);
  const std::string worst = Format(Percentile(errors, 100), digits);
  return median == "-" && worst == "-" ? "-" : fmt::format("{} ({})", median, worst);
}

/// Formats the median share and, in brackets, the least one, in percent.
std::string Shares(const std::vector<const TrialResult*>& results, Figure share) {
  const std::vector<double> shares = Errors(results, share);
  return fmt::format("{:.1f} ({:.1f})", 100 * Percentile(shares, 50), 100 * Percentile(shares, 0));
}

std::string SummaryLine(const std::string& scenario, const std::vector<Trial>& trials) {
  std::vector<const TrialResult*> results;
  std::vector<double> losses;
  for (const Trial& trial : trials) {
    if (trial.scenario != scenario) continue;
    results.push_back(&trial.result);
    losses.push_back(trial.result.losses);
  }
  if (results.empty()) return "";
  const auto spread = [&](Figure figure, int digits) {
    return Spread(Errors(results, figure), digits);
  };
  return fmt::format(
      "| {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n", scenario,
      spread(&TrialResult::ate, 4), spread(&TrialResult::live_ate, 4),
      Shares(results, &TrialResult::posed_share), Spread(losses, 0),
      spread(&TrialResult::t_rel_percent, 2), spread(&TrialResult::r_rel_deg_per_100m, 2),
      spread(&TrialResult::rpe, 4), spread(&TrialResult::scale_drift, 3),
      spread(&TrialResult::rotation_deg, 2), Shares(results, &TrialResult::rotation_share),
      spread(&TrialResult::processor_ms, 1), spread(&TrialResult::peak_memory_mb, 0));
}

}  // namespace

std::string SummaryTable(const std::vector<Trial>& trials) {
  std::string table =
      "| median (worst) | ATE, m | ATE of live poses, m | posed, % | losses | t_rel, % | r_rel, "
      "°/100 m | RPE, m a frame "
      "| "
      "scale, last third / first | rotation, ° over 1 s | rotation known, % | processor, ms a "
      "frame "
      "| peak memory, MB |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
  std::vector<std::string> scenarios;
  for (const Trial& trial : trials) {
    if (std::find(scenarios.begin(), scenarios.end(), trial.scenario) == scenarios.end()) {
      scenarios.push_back(trial.scenario);
    }
  }
  for (const std::string& scenario : scenarios) table += SummaryLine(scenario, trials);
  return table;
}

std::string TrialTable(const std::vector<Trial>& trials) {
  std::string table =
      "| scenario | start | ATE, m | posed, % | losses | scale | rotation, ° over 1 s | ms "
      "a "
      "frame |\n|---|---|---|---|---|---|---|---|\n";
  for (const Trial& trial : trials) {
    const TrialResult& result = trial.result;
    table +=
        fmt::format("| {} | {} | {} | {:.1f} | {} | {} | {} | {:.1f} |\n", trial.scenario,
                    trial.start, Format(result.ate, 4), 100 * result.posed_share, result.losses,
                    Format(result.scale_drift, 3), Format(result.rotation_deg, 2), result.wall_ms);
  }
  return table;
}

nlohmann::ordered_json ToJson(const std::vector<Trial>& trials) {
  auto json = nlohmann::ordered_json::array();
  for (const Trial& trial : trials) {
    const TrialResult& result = trial.result;
    json.push_back({{"scenario", trial.scenario},
                    {"start", trial.start},
                    {"frames", result.frames},
                    {"posed_share", result.posed_share},
                    {"rotation_share", result.rotation_share},
                    {"segments", result.segments},
                    {"losses", result.losses},
                    {"ate", result.ate},
                    {"live_ate", result.live_ate},
                    {"t_rel_percent", result.t_rel_percent},
                    {"r_rel_deg_per_100m", result.r_rel_deg_per_100m},
                    {"rpe", result.rpe},
                    {"rotation_deg", result.rotation_deg},
                    {"scale_drift", result.scale_drift},
                    {"scale_percent_per_km", result.scale_percent_per_km},
                    {"wall_ms", result.wall_ms},
                    {"processor_ms", result.processor_ms},
                    {"peak_memory_mb", result.peak_memory_mb}});
  }
  return json;
}

}  // namespace corvo::bench
