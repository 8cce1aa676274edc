// SPDX-License-Identifier: MIT
#include "bench/quality/runner.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

namespace corvo::bench {
namespace {

/// Returns the points inside the circle inscribed in the image.
DescribedPoints KeepInCircle(const DescribedPoints& described, cv::Size size) {
  const double radius = 0.5 * (std::min(size.width, size.height) - 1);
  DescribedPoints kept;
  kept.norm = described.norm;
  for (std::size_t i = 0; i < described.points.size(); ++i) {
    const cv::Point2f& point = described.points[i].pt;
    const double x = point.x - 0.5 * (size.width - 1), y = point.y - 0.5 * (size.height - 1);
    if (std::hypot(x, y) > radius) continue;
    kept.points.push_back(described.points[i]);
    kept.descriptors.push_back(described.descriptors.row(static_cast<int>(i)));
  }
  return kept;
}

}  // namespace

std::vector<PairResult> RunTasks(const Contender& contender, const std::vector<PairTask>& tasks,
                                 int num_features) {
  std::map<std::string, DescribedPoints> firsts;
  std::vector<PairResult> results;
  for (const PairTask& task : tasks) {
    if (!firsts.contains(task.image)) {
      firsts[task.image] = Describe(contender, task.first, num_features);
    }
    const View view = task.second();
    PointPair pair = {firsts[task.image], Describe(contender, view.image, num_features),
                      view.from_first, task.first.size(), view.image.size()};
    if (task.in_circle) {
      pair.first = KeepInCircle(pair.first, pair.first_size);
      pair.second = KeepInCircle(pair.second, pair.second_size);
    }
    results.push_back({contender.name, task.series, task.image, task.parameter, Measure(pair)});
  }
  return results;
}

Measures SumOf(const std::vector<PairResult>& results, const std::string& contender,
               const std::string& series) {
  Measures sum;
  for (const PairResult& result : results) {
    if (result.contender == contender && result.series == series) sum += result.measures;
  }
  return sum;
}

Measures SumOf(const std::vector<PairResult>& results, const std::string& contender,
               const std::string& series, double parameter) {
  std::vector<PairResult> some;
  std::copy_if(results.begin(), results.end(), std::back_inserter(some),
               [&](const PairResult& result) { return result.parameter == parameter; });
  return SumOf(some, contender, series);
}

}  // namespace corvo::bench
