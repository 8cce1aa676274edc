// SPDX-License-Identifier: MIT
#include "bench/quality/measures.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <utility>

#include <opencv2/features2d.hpp>

namespace corvo::bench {
namespace {

using Points = std::vector<cv::KeyPoint>;

cv::Point2d Map(const cv::Matx33d& target_from_source, const cv::Point2f& point) {
  const cv::Vec3d mapped = target_from_source * cv::Vec3d(point.x, point.y, 1);
  return {mapped[0] / mapped[2], mapped[1] / mapped[2]};
}

std::vector<cv::Point2d> MapAll(const cv::Matx33d& target_from_source, const Points& points) {
  std::vector<cv::Point2d> mapped;
  for (const cv::KeyPoint& point : points) mapped.push_back(Map(target_from_source, point.pt));
  return mapped;
}

/// Returns whether a point rounds to a pixel of an image.
bool IsInside(const cv::Point2d& point, cv::Size size) {
  return point.x > -0.5 && point.y > -0.5 && point.x < size.width - 0.5 &&
         point.y < size.height - 0.5;
}

double Distance(const cv::Point2d& a, const cv::Point2f& b) {
  return std::hypot(a.x - b.x, a.y - b.y);
}

std::vector<bool> FindInside(const std::vector<cv::Point2d>& points, cv::Size size) {
  std::vector<bool> inside;
  for (const cv::Point2d& point : points) inside.push_back(IsInside(point, size));
  return inside;
}

/// Sets `repeated` and `paired` of `measures`.
void CountNear(const std::vector<cv::Point2d>& first, const std::vector<bool>& first_counts,
               const Points& second, const std::vector<bool>& second_counts, Measures& measures) {
  std::vector<std::tuple<double, std::size_t, std::size_t>> near;
  std::set<std::size_t> repeated;
  for (std::size_t i = 0; i < first.size(); ++i) {
    for (std::size_t j = 0; first_counts[i] && j < second.size(); ++j) {
      const double distance = Distance(first[i], second[j].pt);
      if (distance > kTolerancePx) continue;
      repeated.insert(i);
      if (second_counts[j]) near.emplace_back(distance, i, j);
    }
  }
  std::sort(near.begin(), near.end());
  std::set<std::size_t> used_first, used_second;
  for (const auto& [distance, i, j] : near) {
    if (used_first.contains(i) || used_second.contains(j)) continue;
    used_first.insert(i);
    used_second.insert(j);
  }
  measures.repeated = static_cast<int>(repeated.size());
  measures.paired = static_cast<int>(used_first.size());
}

/// Returns for each query the index of the nearest train descriptor, or -1 if there is none.
std::vector<int> FindNearest(const DescribedPoints& queries, const DescribedPoints& train) {
  std::vector<int> nearest(queries.points.size(), -1);
  if (queries.points.empty() || train.points.empty()) return nearest;
  std::vector<cv::DMatch> matches;
  cv::BFMatcher(queries.norm).match(queries.descriptors, train.descriptors, matches);
  for (const cv::DMatch& match : matches) nearest[match.queryIdx] = match.trainIdx;
  return nearest;
}

void CountMatches(const PointPair& pair, const std::vector<cv::Point2d>& mapped,
                  const std::vector<bool>& counts, Measures& measures) {
  const std::vector<int> forward = FindNearest(pair.first, pair.second);
  const std::vector<int> backward = FindNearest(pair.second, pair.first);
  for (int i = 0; i < static_cast<int>(mapped.size()); ++i) {
    if (!counts[i] || forward[i] < 0) continue;
    const bool correct = Distance(mapped[i], pair.second.points[forward[i]].pt) <= kTolerancePx;
    const bool mutual = backward[forward[i]] == i;
    measures.nearest_correct += correct;
    measures.mutual += mutual;
    measures.mutual_correct += mutual && correct;
  }
}

}  // namespace

Measures& Measures::operator+=(const Measures& other) {
  images += other.images;
  first += other.first;
  fewer += other.fewer;
  repeated += other.repeated;
  paired += other.paired;
  nearest_correct += other.nearest_correct;
  mutual += other.mutual;
  mutual_correct += other.mutual_correct;
  return *this;
}

Measures Measure(const PointPair& pair) {
  const std::vector<cv::Point2d> mapped = MapAll(pair.second_from_first, pair.first.points);
  const std::vector<bool> first = FindInside(mapped, pair.second_size);
  const std::vector<bool> second =
      FindInside(MapAll(pair.second_from_first.inv(), pair.second.points), pair.first_size);
  Measures measures;
  measures.images = 1;
  measures.first = static_cast<int>(std::count(first.begin(), first.end(), true));
  measures.fewer =
      std::min(measures.first, static_cast<int>(std::count(second.begin(), second.end(), true)));
  CountNear(mapped, first, pair.second.points, second, measures);
  CountMatches(pair, mapped, first, measures);
  return measures;
}

double Spread(const Points& points, cv::Size size) {
  constexpr int kColumns = 32, kRows = 24;
  std::set<std::pair<int, int>> occupied;
  for (const cv::KeyPoint& point : points) {
    occupied.emplace(static_cast<int>((point.pt.x + 0.5F) * kColumns / size.width),
                     static_cast<int>((point.pt.y + 0.5F) * kRows / size.height));
  }
  return static_cast<double>(occupied.size()) / (kColumns * kRows);
}

}  // namespace corvo::bench
