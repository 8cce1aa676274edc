// SPDX-License-Identifier: MIT
#include "vo/mapping/contested_keypoints.h"

#include <algorithm>
#include <utility>

namespace corvo {
namespace {

/// The number of nearest matched keypoints that decide.
constexpr int kNumNeighbors = 12;
/// The least share of contradictions among them at a contested keypoint: 10 of 12. Where a fifth of
/// the matches are outliers at random, that has a probability of 5e-6.
constexpr double kMinShare = 0.83;

/// A keypoint that was matched with a landmark.
struct Matched {
  Eigen::Vector2d pixel;
  bool is_contradiction;
};

std::vector<Matched> CollectMatched(const std::vector<int>& contradictions, const Frame& frame) {
  std::vector<Matched> matched;
  for (const int k : contradictions) matched.push_back({frame.pixel(k), true});
  for (int k = 0; k < frame.num_keypoints(); ++k) {
    if (frame.landmarks[k] != kNoId) matched.push_back({frame.pixel(k), false});
  }
  return matched;
}

bool IsContested(const Eigen::Vector2d& pixel, const std::vector<Matched>& matched) {
  std::vector<std::pair<double, int>> by_distance;
  for (const Matched& m : matched) {
    by_distance.emplace_back((m.pixel - pixel).squaredNorm(), m.is_contradiction);
  }
  const int count = std::min(kNumNeighbors, static_cast<int>(by_distance.size()));
  std::partial_sort(by_distance.begin(), by_distance.begin() + count, by_distance.end());
  int num_contradictions = 0;
  for (int i = 0; i < count; ++i) num_contradictions += by_distance[i].second;
  return num_contradictions >= kMinShare * count;
}

}  // namespace

double RemoveContestedKeypoints(const std::vector<int>& contradictions, Frame& frame) {
  if (contradictions.empty()) return 0;
  const std::vector<Matched> matched = CollectMatched(contradictions, frame);
  std::vector<int> kept;
  for (int k = 0; k < frame.num_keypoints(); ++k) {
    const bool is_kept = frame.landmarks[k] != kNoId || !IsContested(frame.pixel(k), matched);
    if (is_kept) kept.push_back(k);
  }
  const auto num_all = static_cast<double>(frame.num_keypoints());
  SelectKeypoints(kept, frame);
  return 1 - frame.num_keypoints() / num_all;
}

}  // namespace corvo
