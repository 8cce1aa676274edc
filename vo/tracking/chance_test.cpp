// SPDX-License-Identifier: MIT
#include "vo/tracking/chance_test.h"

#include <algorithm>
#include <cmath>

namespace corvo {
namespace {

constexpr double kRadiusPx = 3;  ///< Of the search, px of the octave.
/// As many matches can be had by choosing the six parameters of a pose.
constexpr int kFreeMatches = 3;
constexpr double kMaxLogFalseAlarms = -9.2;  ///< ln(1e-4): a chance pose in ten thousand frames.
/// Displacements as shares of the size of the image: far enough to miss the landmarks.
constexpr double kDisplacements[][2] = {{0.07, 0}, {-0.07, 0}, {0, 0.09}, {0, -0.09}};

/// The number of queries for each displacement: enough to know the share of chance matches.
constexpr int kNumDisplaced = 100;

/// An even selection of the queries, displaced in the image; those that leave it are dropped.
GuidedQueries Displace(const GuidedQueries& queries, const Eigen::Vector2d& offset,
                       const Camera& camera) {
  GuidedQueries displaced;
  const int step = std::max(1, queries.size() / kNumDisplaced);
  for (int i = 0; i < queries.size(); i += step) {
    const Eigen::Vector2d pixel = queries.pixels[i] + offset;
    if (!camera.Contains(pixel)) continue;
    displaced.ids.push_back(queries.ids[i]);
    displaced.descriptors.push_back(queries.descriptors[i]);
    displaced.pixels.push_back(pixel);
    orb::SearchWindow window = queries.windows[i];
    window.x = static_cast<float>(pixel.x());
    window.y = static_cast<float>(pixel.y());
    displaced.windows.push_back(window);
  }
  return displaced;
}

/// The share of queries that are matched at positions where the landmarks are not; at least one
/// match is assumed, so that the share is never zero.
double MeasureChance(const GuidedQueries& queries, const Frame& frame,
                     const GuidedMatchingOptions& matching, const Camera& camera) {
  double num_queries = 1, num_matches = 1;
  for (const auto& [x, y] : kDisplacements) {
    const GuidedQueries displaced =
        Displace(queries, {x * camera.width(), y * camera.height()}, camera);
    num_queries += displaced.size();
    num_matches += static_cast<double>(MatchGuided(displaced, frame, matching).size());
  }
  return num_matches / num_queries;
}

/// The Kullback-Leibler divergence between two Bernoulli distributions, neither 0 nor 1.
double Divergence(double share, double chance) {
  return share * std::log(share / chance) + (1 - share) * std::log((1 - share) / (1 - chance));
}

}  // namespace

bool IsBeyondChance(const Map& map, const std::vector<LandmarkId>& landmarks, const Frame& frame,
                    const GuidedMatchingOptions& matching) {
  const GuidedQueries queries =
      ProjectLandmarks(map, landmarks, frame.world_from_camera, {kRadiusPx, kRadiusPx, 0, 1, 1});
  const double num_queries = queries.size();
  const double num_matches =
      static_cast<double>(MatchGuided(queries, frame, matching).size()) - kFreeMatches;
  if (num_matches <= 0) return false;
  const double chance = MeasureChance(queries, frame, matching, map.camera());
  const double share = num_matches / num_queries;
  if (share <= chance || chance >= 1) return false;
  return -num_queries * Divergence(share, chance) < kMaxLogFalseAlarms;
}

}  // namespace corvo
