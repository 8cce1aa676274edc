// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "orb/keypoint_index.h"
#include "orb/nearest.h"
#include "orb/types.h"

namespace corvo::orb {

/// A correspondence between keypoint `query` of one image and keypoint `train` of another.
struct Match {
  int query = -1;
  int train = -1;
  int distance = 257;  ///< Bits.

  bool operator==(const Match&) const = default;
};

/// Returns the exact two nearest neighbors of every query among all of `train`, in query order.
std::vector<Nearest> FindNearest(std::span<const Descriptor> queries,
                                 std::span<const Descriptor> train);

/// Returns the exact two nearest neighbors of `query` among train[candidates[i]]. The candidates
/// are distinct indices into `train`, in any order.
Nearest FindNearestAmong(const Descriptor& query, std::span<const Descriptor> train,
                         std::span<const int> candidates);

/// Like FindNearest(), but the candidates of query i are the train keypoints inside windows[i].
/// `train_index` contains the keypoints that `train` describes. Throws corvo::Error if the sizes do
/// not match.
std::vector<Nearest> FindNearestInWindows(std::span<const Descriptor> queries,
                                          std::span<const SearchWindow> windows,
                                          std::span<const Descriptor> train,
                                          const KeypointIndex& train_index);

/// Returns the nearest neighbors at most `max_distance` bits away, as matches in query order.
std::vector<Match> DistanceTest(std::span<const Nearest> nearest, int max_distance);

/// Applies Lowe's ratio test: keeps a query whose distance is below `ratio` times its second
/// distance, and sets the index of all others to -1. A query with a single candidate is kept.
std::vector<Nearest> RatioTest(std::span<const Nearest> nearest, double ratio);

/// Keeps matches whose train keypoint has the query as its own nearest neighbor. Throws
/// corvo::Error if a match has no entry in `nearest_of_train`.
std::vector<Match> CrossCheck(std::span<const Match> matches,
                              std::span<const Nearest> nearest_of_train);

/// Keeps the nearest of all matches with the same train keypoint (ties: the lowest query).
std::vector<Match> KeepUnique(std::span<const Match> matches);

/// Keeps the matches whose change of angle, train minus query, lies in one of the three fullest of
/// `bins` bins around the circle (bins with less than a tenth of the fullest do not count; ties go
/// to the lower bin). The first bin is centered on 0. Throws corvo::Error if the index of a match
/// has no keypoint, or if `bins` is less than 1.
std::vector<Match> KeepConsistentRotation(std::span<const Match> matches,
                                          std::span<const Keypoint> query_keypoints,
                                          std::span<const Keypoint> train_keypoints, int bins = 30);

}  // namespace corvo::orb
