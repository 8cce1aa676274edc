// SPDX-License-Identifier: MIT
#include "bench/quality/scale_bias.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace corvo::bench {
namespace {

using Points = std::vector<cv::KeyPoint>;

/// Returns twice the error that shifts both points of a pair in the same direction.
cv::Point2d Excess(const cv::KeyPoint& point, const cv::KeyPoint& turned, cv::Size size) {
  return {double{point.pt.x} + turned.pt.x - (size.width - 1),
          double{point.pt.y} + turned.pt.y - (size.height - 1)};
}

struct Candidate {
  double distance = 0;
  std::size_t first = 0;
  std::size_t second = 0;

  auto operator<=>(const Candidate&) const = default;
};

std::vector<Candidate> FindCandidates(const Points& points, const Points& turned, cv::Size size,
                                      double reach_px) {
  std::vector<Candidate> candidates;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < turned.size(); ++j) {
      if (points[i].octave != turned[j].octave) continue;
      const double distance = cv::norm(Excess(points[i], turned[j], size));
      if (distance <= reach_px) candidates.push_back({distance, i, j});
    }
  }
  std::sort(candidates.begin(), candidates.end());
  return candidates;
}

}  // namespace

std::vector<OctaveBias> MeasureBias(const Points& points, const Points& turned, cv::Size size,
                                    double reach_px) {
  std::vector<bool> free_first(points.size(), true), free_second(turned.size(), true);
  std::vector<OctaveBias> pairs;
  for (const Candidate& candidate : FindCandidates(points, turned, size, reach_px)) {
    if (!free_first[candidate.first] || !free_second[candidate.second]) continue;
    free_first[candidate.first] = free_second[candidate.second] = false;
    const cv::KeyPoint& point = points[candidate.first];
    pairs.push_back({point.octave, 1, 0.5 * Excess(point, turned[candidate.second], size)});
  }
  return MergeOctaves(pairs);
}

std::vector<OctaveBias> MergeOctaves(const std::vector<OctaveBias>& biases) {
  std::map<int, OctaveBias> sums;
  for (const OctaveBias& bias : biases) {
    OctaveBias& sum = sums[bias.octave];
    sum.pairs += bias.pairs;
    sum.px += bias.pairs * bias.px;
  }
  std::vector<OctaveBias> means;
  for (const auto& [octave, sum] : sums) means.push_back({octave, sum.pairs, sum.px / sum.pairs});
  return means;
}

}  // namespace corvo::bench
