// SPDX-License-Identifier: MIT
#include "orb/matcher.h"

#include <algorithm>
#include <memory>
#include <numeric>
#include <string>

#include "orb/error.h"
#include "orb/kernels/nearest_among.h"
#include "orb/kernels/nearest_two.h"
#include "orb/rounding.h"

namespace corvo::orb {
namespace {

void CheckSameSize(const char* what, std::size_t a, std::size_t b) {
  if (a == b) return;
  throw Error(std::string(what) + ": " + std::to_string(a) + " and " + std::to_string(b) +
              "; allowed are equal numbers");
}

void CheckIndex(const char* what, int index, std::size_t size) {
  if (index >= 0 && static_cast<std::size_t>(index) < size) return;
  throw Error(std::string(what) + " of a match is " + std::to_string(index) + "; there are " +
              std::to_string(size));
}

/// Returns the bin of the change of angle; the first bin is centered on 0.
int RotationBin(float query_deg, float train_deg, int bins) {
  const double change = static_cast<double>(train_deg) - query_deg;
  const double turns = (change < 0 ? change + 360.0 : change) / 360.0;
  return RoundHalfUp(turns * bins) % bins;
}

/// Returns, for each bin, whether it is among the three fullest and holds at least a tenth of the
/// fullest.
std::vector<bool> DominantBins(const std::vector<int>& counts) {
  std::vector<int> order(counts.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return counts[a] > counts[b]; });
  order.resize(std::min<std::size_t>(order.size(), 3));
  std::vector<bool> dominant(counts.size(), false);
  for (const int bin : order) dominant[bin] = 10 * counts[bin] >= counts[order.front()];
  return dominant;
}

}  // namespace

std::vector<Nearest> FindNearest(std::span<const Descriptor> queries,
                                 std::span<const Descriptor> train) {
  std::vector<Nearest> nearest(queries.size());
  const auto scratch = std::make_unique_for_overwrite<kernels::NearestTwoScratch>();
  kernels::FindNearestTwo(queries, train, *scratch, nearest.data());
  return nearest;
}

Nearest FindNearestAmong(const Descriptor& query, std::span<const Descriptor> train,
                         std::span<const int> candidates) {
  return kernels::FindNearestAmong(query, train.data(), candidates.data(),
                                   static_cast<int>(candidates.size()));
}

std::vector<Nearest> FindNearestInWindows(std::span<const Descriptor> queries,
                                          std::span<const SearchWindow> windows,
                                          std::span<const Descriptor> train,
                                          const KeypointIndex& train_index) {
  CheckSameSize("queries and windows", queries.size(), windows.size());
  CheckSameSize("train descriptors and indexed keypoints", train.size(), train_index.size());
  std::vector<Nearest> nearest(queries.size());
  std::vector<int> candidates;
  for (std::size_t i = 0; i < queries.size(); ++i) {
    candidates.clear();
    train_index.FindUnordered(windows[i], candidates);
    nearest[i] = FindNearestAmong(queries[i], train, candidates);
  }
  return nearest;
}

std::vector<Match> DistanceTest(std::span<const Nearest> nearest, int max_distance) {
  std::vector<Match> matches;
  for (std::size_t i = 0; i < nearest.size(); ++i) {
    if (nearest[i].index < 0 || nearest[i].distance > max_distance) continue;
    matches.push_back({static_cast<int>(i), nearest[i].index, nearest[i].distance});
  }
  return matches;
}

std::vector<Nearest> RatioTest(std::span<const Nearest> nearest, double ratio) {
  std::vector<Nearest> kept(nearest.begin(), nearest.end());
  for (Nearest& entry : kept) {
    const bool single = entry.second_index < 0;
    if (!single && !(entry.distance < ratio * entry.second_distance)) entry.index = -1;
  }
  return kept;
}

std::vector<Match> CrossCheck(std::span<const Match> matches,
                              std::span<const Nearest> nearest_of_train) {
  std::vector<Match> kept;
  for (const Match& match : matches) {
    CheckIndex("train", match.train, nearest_of_train.size());
    if (nearest_of_train[match.train].index == match.query) kept.push_back(match);
  }
  return kept;
}

std::vector<Match> KeepUnique(std::span<const Match> matches) {
  std::vector<int> order(matches.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    const Match& first = matches[a];
    const Match& second = matches[b];
    if (first.train != second.train) return first.train < second.train;
    if (first.distance != second.distance) return first.distance < second.distance;
    return first.query < second.query;
  });
  const auto end = std::unique(order.begin(), order.end(),
                               [&](int a, int b) { return matches[a].train == matches[b].train; });
  order.erase(end, order.end());
  std::sort(order.begin(), order.end());
  std::vector<Match> kept;
  kept.reserve(order.size());
  for (const int i : order) kept.push_back(matches[i]);
  return kept;
}

std::vector<Match> KeepConsistentRotation(std::span<const Match> matches,
                                          std::span<const Keypoint> query_keypoints,
                                          std::span<const Keypoint> train_keypoints, int bins) {
  if (bins < 1) throw Error("bins is " + std::to_string(bins) + "; allowed is 1 or more");
  std::vector<int> bin_of(matches.size());
  std::vector<int> counts(bins, 0);
  for (std::size_t i = 0; i < matches.size(); ++i) {
    CheckIndex("query", matches[i].query, query_keypoints.size());
    CheckIndex("train", matches[i].train, train_keypoints.size());
    bin_of[i] = RotationBin(query_keypoints[matches[i].query].angle_deg,
                            train_keypoints[matches[i].train].angle_deg, bins);
    ++counts[bin_of[i]];
  }
  const std::vector<bool> dominant = DominantBins(counts);
  std::vector<Match> kept;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (dominant[bin_of[i]]) kept.push_back(matches[i]);
  }
  return kept;
}

}  // namespace corvo::orb
