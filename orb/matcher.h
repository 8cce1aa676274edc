// SPDX-License-Identifier: MIT
#pragma once

#include <span>
#include <vector>

#include "orb/keypoint_index.h"
#include "orb/nearest.h"
#include "orb/types.h"

namespace corvo::orb {

/// Keypoint `query` of one image corresponds to keypoint `train` of another.
struct Match {
  int query = -1;
  int train = -1;
  int distance = 257;  ///< Bits.

  bool operator==(const Match&) const = default;
};

/// Exact two nearest neighbors of every query among all of `train`, in query order.
std::vector<Nearest> FindNearest(std::span<const Descriptor> queries,
                                 std::span<const Descriptor> train);

/// Exact two nearest neighbors of `query` among train[candidates[i]]. Candidates are different
/// indices within `train`, in any order.
Nearest FindNearestAmong(const Descriptor& query, std::span<const Descriptor> train,
                         std::span<const int> candidates);

/// As FindNearest, but query i sees only the train keypoints inside windows[i]. `train_index` is of
/// the keypoints that `train` describes. Throws corvo::Error where the sizes do not fit.
std::vector<Nearest> FindNearestInWindows(std::span<const Descriptor> queries,
                                          std::span<const SearchWindow> windows,
                                          std::span<const Descriptor> train,
                                          const KeypointIndex& train_index);

/// Nearest neighbors at most `max_distance` bits away, as matches in query order.
std::vector<Match> DistanceTest(std::span<const Nearest> nearest, int max_distance);

/// Lowe's ratio test, decided in integers where it can be: keeps a query whose distance is below
/// `ratio` times its second distance, and clears (index -1) all others. A query with a single
/// candidate is kept.
std::vector<Nearest> RatioTest(std::span<const Nearest> nearest, double ratio);

/// Keeps matches whose train keypoint has the query as its own nearest neighbor. Throws
/// corvo::Error on a match without an entry of `nearest_of_train`.
std::vector<Match> CrossCheck(std::span<const Match> matches,
                              std::span<const Nearest> nearest_of_train);

/// Where several queries chose one train keypoint, keeps the nearest (ties: the lowest query).
std::vector<Match> KeepUnique(std::span<const Match> matches);

/// Keeps the matches whose change of angle, train minus query, lies in one of the three fullest of
/// `bins` bins around the circle (a bin with less than a tenth of the fullest does not count; ties
/// go to the lower bin). The first bin is centered on 0. Throws corvo::Error on a match without its
/// keypoints and on fewer than 1 bin.
std::vector<Match> KeepConsistentRotation(std::span<const Match> matches,
                                          std::span<const Keypoint> query_keypoints,
                                          std::span<const Keypoint> train_keypoints, int bins = 30);

}  // namespace corvo::orb
