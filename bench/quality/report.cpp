// SPDX-License-Identifier: MIT
#include "bench/quality/report.h"

#include <algorithm>

#include <fmt/format.h>

namespace corvo::bench {
namespace {

constexpr int kMinPairs = 50;

std::vector<std::string> DistinctSeries(const QualityReport& report) {
  std::vector<std::string> series;
  for (const PairResult& result : report.pairs) {
    if (std::find(series.begin(), series.end(), result.series) == series.end()) {
      series.push_back(result.series);
    }
  }
  return series;
}

const KeypointResult& KeypointsOf(const QualityReport& report, const std::string& contender) {
  return *std::find_if(report.keypoints.begin(), report.keypoints.end(),
                       [&](const KeypointResult& result) { return result.contender == contender; });
}

std::string CorrectMatches(const Measures& sum, const std::string& series) {
  const bool is_oxford = series.rfind("oxford", 0) == 0;
  return fmt::format("{:.0f}", is_oxford ? sum.mutual_correct
                                         : static_cast<double>(sum.mutual_correct) / sum.images);
}

using Share = double (Measures::*)() const;

template <typename Text>
std::string Line(const QualityReport& report, const std::string& measure, const std::string& images,
                 const Text& text) {
  std::string line = fmt::format("| {} | {} |", measure, images);
  for (const std::string& contender : report.contenders) {
    line += fmt::format(" {} |", text(contender));
  }
  return line + "\n";
}

std::string ShareLines(const QualityReport& report, const std::string& measure, Share share) {
  std::string lines;
  for (const std::string& series : DistinctSeries(report)) {
    lines += Line(report, measure, series, [&](const std::string& contender) {
      return fmt::format("{:.3f}", (SumOf(report.pairs, contender, series).*share)());
    });
  }
  return lines;
}

std::string MatchLines(const QualityReport& report) {
  std::string lines;
  for (const std::string& series : DistinctSeries(report)) {
    lines += Line(report, "mutual correct matches", series, [&](const std::string& contender) {
      return CorrectMatches(SumOf(report.pairs, contender, series), series);
    });
  }
  return lines;
}

std::string KeypointLines(const QualityReport& report) {
  std::string lines;
  for (std::size_t i = 0; i < report.spread_folders.size(); ++i) {
    lines += Line(report, "spread", report.spread_folders[i], [&](const std::string& contender) {
      return fmt::format("{:.3f}", KeypointsOf(report, contender).spread[i]);
    });
  }
  lines += Line(report, "scale bias, px", "greatest of an octave", [&](const auto& contender) {
    return fmt::format("{:.3f}", KeypointsOf(report, contender).MaxBiasPx());
  });
  return lines;
}

/// One line of RequirementTable().
struct Requirement {
  std::string what;
  double value = 0;
  double reference = 0;
  double must = 0;
  double aim = 0;
  bool less_is_better = false;
};

std::string Line(const Requirement& requirement) {
  const auto holds = [&](double limit) {
    return requirement.less_is_better ? requirement.value <= limit : requirement.value >= limit;
  };
  const char* reached = holds(requirement.aim) ? "aim" : holds(requirement.must) ? "must" : "no";
  return fmt::format("| {} | {:.4g} | {:.4g} | {:.4g} | {:.4g} | {} |\n", requirement.what,
                     requirement.value, requirement.reference, requirement.must, requirement.aim,
                     reached);
}

// References that are not measured here are those of ORB-SLAM on the same images.

std::vector<Requirement> GridRequirements(const QualityReport& report) {
  const std::string grid = "corvo, grid";
  std::vector<Requirement> requirements;
  const double graf[] = {234, 117, 52};
  for (int i = 0; i < 3; ++i) {
    const Measures sum = SumOf(report.pairs, grid, "oxford graf", i + 2);
    if (sum.images == 0) continue;
    requirements.push_back({fmt::format("grid: mutual correct, graf 1-{}", i + 2),
                            static_cast<double>(sum.mutual_correct), graf[i], 1.10 * graf[i],
                            1.25 * graf[i]});
  }
  const Measures sum = SumOf(report.pairs, grid, "rotation, sigma 10");
  const double orb = SumOf(report.pairs, "cv::ORB", "rotation, sigma 10").Precision();
  requirements.push_back(
      {"grid: precision, rotation, sigma 10", sum.Precision(), orb, 0.68 * orb, 0.75 * orb});
  requirements.push_back(
      {"grid: repeatability, rotation, sigma 10", sum.Repeatability(), 0.640, 0.70, 0.75});
  requirements.push_back({"grid: one-to-one repeatability, rotation, sigma 10",
                          sum.PairedRepeatability(), 0.640, 0.70, 0.75});
  const KeypointResult& keypoints = KeypointsOf(report, grid);
  const double spread[] = {0.39, 0.43};
  for (std::size_t i = 0; i < keypoints.spread.size() && i < 2; ++i) {
    requirements.push_back({"grid: spread, " + report.spread_folders[i], keypoints.spread[i],
                            spread[i], spread[i], 1.1 * spread[i]});
  }
  requirements.push_back({"grid: scale bias, px", keypoints.MaxBiasPx(),
                          KeypointsOf(report, "cv::ORB").MaxBiasPx(), 0.1, 0.03, true});
  return requirements;
}

std::vector<Requirement> GlobalRequirements(const QualityReport& report) {
  const std::string global = "corvo, global", orb = "cv::ORB", rotation = "rotation, sigma 10";
  const double precision = SumOf(report.pairs, orb, rotation).Precision();
  std::vector<Requirement> requirements = {{"global: precision, " + rotation,
                                            SumOf(report.pairs, global, rotation).Precision(),
                                            precision, precision, 1.05 * precision}};
  double ratios = 0;
  int count = 0;
  for (const std::string& series : DistinctSeries(report)) {
    if (series.rfind("oxford", 0) != 0) continue;
    const double correct = SumOf(report.pairs, global, series).mutual_correct;
    const double reference = SumOf(report.pairs, orb, series).mutual_correct;
    requirements.push_back(
        {"global: mutual correct, " + series, correct, reference, reference, 1.1 * reference});
    ratios += correct / reference;
    ++count;
  }
  requirements.push_back(
      {"global: mutual correct, mean ratio to cv::ORB", ratios / count, 1, 1, 1.1});
  return requirements;
}

}  // namespace

double KeypointResult::MaxBiasPx() const {
  double greatest = 0;
  for (const OctaveBias& octave : bias) {
    if (octave.pairs >= kMinPairs) greatest = std::max(greatest, cv::norm(octave.px));
  }
  return greatest;
}

std::string QualityTable(const QualityReport& report) {
  std::string table = "| measure | images |";
  std::string rule = "|---|---|";
  for (const std::string& contender : report.contenders) {
    table += fmt::format(" {} |", contender);
    rule += "---|";
  }
  table += "\n" + rule + "\n";
  table += ShareLines(report, "repeatability", &Measures::Repeatability);
  table += ShareLines(report, "repeatability, one to one", &Measures::PairedRepeatability);
  table += ShareLines(report, "precision", &Measures::Precision);
  table += MatchLines(report);
  table += ShareLines(report, "matching score", &Measures::MatchingScore);
  return table + KeypointLines(report);
}

std::string RequirementTable(const QualityReport& report) {
  std::string table =
      "| required | corvo | reference | must | aim | reached |\n|---|---|---|---|---|---|\n";
  for (const auto& requirements : {GridRequirements(report), GlobalRequirements(report)}) {
    for (const Requirement& requirement : requirements) table += Line(requirement);
  }
  return table;
}

nlohmann::ordered_json ToJson(const QualityReport& report) {
  nlohmann::ordered_json json = {{"pairs", nlohmann::ordered_json::array()},
                                 {"keypoints", nlohmann::ordered_json::array()}};
  for (const PairResult& result : report.pairs) {
    const Measures& measures = result.measures;
    json["pairs"].push_back({{"contender", result.contender},
                             {"series", result.series},
                             {"image", result.image},
                             {"parameter", result.parameter},
                             {"keypoints", measures.first},
                             {"keypoints_of_fewer", measures.fewer},
                             {"repeated", measures.repeated},
                             {"paired", measures.paired},
                             {"nearest_correct", measures.nearest_correct},
                             {"mutual", measures.mutual},
                             {"mutual_correct", measures.mutual_correct}});
  }
  for (const KeypointResult& result : report.keypoints) {
    nlohmann::ordered_json entry = {{"contender", result.contender}};
    for (std::size_t i = 0; i < result.spread.size(); ++i) {
      entry["spread"][report.spread_folders[i]] = result.spread[i];
    }
    for (const OctaveBias& octave : result.bias) {
      entry["bias"].push_back({{"octave", octave.octave},
                               {"pairs", octave.pairs},
                               {"x_px", octave.px.x},
                               {"y_px", octave.px.y}});
    }
    json["keypoints"].push_back(entry);
  }
  return json;
}

}  // namespace corvo::bench
