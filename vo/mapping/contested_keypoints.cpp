// SPDX-License-Identifier: MIT
#include "vo/mapping/contested_keypoints.h"

#include <algorithm>
#include <cmath>

namespace corvo {
namespace {

/// The number of nearest matched keypoints that decide.
constexpr int kNumNeighbors = 12;
/// The least share of contradictions among them at a contested keypoint: 10 of 12. Where a fifth of
/// the matches are outliers at random, that has a probability of 5e-6.
constexpr double kMinShare = 0.83;

/// The matched keypoints of a frame.
struct MatchedKeypoints {
  std::vector<Eigen::Vector2d> contradictions;
  std::vector<Eigen::Vector2d> others;
};

MatchedKeypoints CollectMatched(const std::vector<int>& contradictions, const Frame& frame) {
  MatchedKeypoints matched;
  for (const int k : contradictions) matched.contradictions.push_back(frame.pixel(k));
  for (int k = 0; k < frame.num_keypoints(); ++k) {
    if (frame.landmarks[k] != kNoId) matched.others.push_back(frame.pixel(k));
  }
  return matched;
}

/// Returns the squared distance of the n-th nearest point, with n from 1 to the number of points.
double FindSquaredDistance(const Eigen::Vector2d& pixel, const std::vector<Eigen::Vector2d>& points,
                           int n) {
  std::vector<double> distances;
  distances.reserve(points.size());
  for (const Eigen::Vector2d& point : points) distances.push_back((point - pixel).squaredNorm());
  std::nth_element(distances.begin(), distances.begin() + n - 1, distances.end());
  return distances[n - 1];
}

/// Whether enough of the nearest matched keypoints are contradictions: at most the rest of the
/// others are nearer than the last contradiction that is needed.
bool IsContested(const Eigen::Vector2d& pixel, const MatchedKeypoints& matched) {
  const auto num_contradictions = static_cast<int>(matched.contradictions.size());
  const int num_matched = num_contradictions + static_cast<int>(matched.others.size());
  const int num_neighbors = std::min(kNumNeighbors, num_matched);
  const int num_needed = static_cast<int>(std::ceil(kMinShare * num_neighbors));
  if (num_contradictions < num_needed) return false;
  const double last = FindSquaredDistance(pixel, matched.contradictions, num_needed);
  int num_nearer = 0;
  for (const Eigen::Vector2d& other : matched.others) {
    num_nearer += (other - pixel).squaredNorm() <= last;
    if (num_nearer > num_neighbors - num_needed) return false;
  }
  return true;
}

}  // namespace

double RemoveContestedKeypoints(const std::vector<int>& contradictions, Frame& frame) {
  if (contradictions.empty()) return 0;
  const MatchedKeypoints matched = CollectMatched(contradictions, frame);
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
