// SPDX-License-Identifier: MIT
#include "orb/matcher.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "orb/extractor.h"
#include "orb/hamming.h"
#include "tests/orb/images.h"
#include "tests/support/data.h"
#include "tests/support/matchers.h"
#include "tests/support/random.h"

namespace corvo::orb {
namespace {

using test::RandomDescriptors;
using test::ThrowsError;
using testing::ElementsAre;
using testing::IsEmpty;

/// Implements the definition: sorts candidates by distance, then by index.
Nearest NaiveNearest(const Descriptor& query, const std::vector<Descriptor>& train,
                     const std::vector<int>& candidates) {
  std::vector<std::pair<int, int>> ranked;
  for (const int j : candidates) ranked.emplace_back(HammingDistance(query, train[j]), j);
  std::sort(ranked.begin(), ranked.end());
  Nearest nearest;
  if (!ranked.empty()) std::tie(nearest.distance, nearest.index) = ranked[0];
  if (ranked.size() > 1) std::tie(nearest.second_distance, nearest.second_index) = ranked[1];
  return nearest;
}

/// Returns descriptors in which few bits vary, so that distances are often equal.
std::vector<Descriptor> SimilarDescriptors(int count, std::uint64_t seed) {
  auto descriptors = RandomDescriptors(count, seed);
  for (auto& descriptor : descriptors) {
    for (std::size_t i = 1; i < 32; ++i) descriptor.bytes[i] = 0;
  }
  return descriptors;
}

TEST(FindNearestTest, EqualsTheNaiveSearchWithTiesToTheLowerIndex) {
  const auto queries = SimilarDescriptors(40, 1);
  const auto train = SimilarDescriptors(90, 2);
  std::vector<int> all(train.size());
  for (std::size_t j = 0; j < all.size(); ++j) all[j] = static_cast<int>(j);
  const auto nearest = FindNearest(queries, train);
  ASSERT_EQ(nearest.size(), queries.size());
  for (std::size_t i = 0; i < queries.size(); ++i) {
    EXPECT_EQ(nearest[i], NaiveNearest(queries[i], train, all));
  }
}

TEST(FindNearestTest, EqualsTheNaiveSearchOnRealImages) {
  CORVO_REQUIRE_DATA("oxford_affine/graf");
  const Extractor extractor({.num_features = 1200});
  const auto queries = extractor.Extract(test::ReadGray("oxford_affine/graf/img1.ppm"));
  const auto train = extractor.Extract(test::ReadGray("oxford_affine/graf/img2.ppm"));
  std::vector<int> all(train.descriptors.size());
  std::iota(all.begin(), all.end(), 0);
  const auto nearest = FindNearest(queries.descriptors, train.descriptors);
  for (std::size_t i = 0; i < nearest.size(); i += 5) {
    EXPECT_EQ(nearest[i], NaiveNearest(queries.descriptors[i], train.descriptors, all));
  }
}

TEST(FindNearestTest, HandlesZeroAndOneCandidates) {
  const auto descriptors = RandomDescriptors(3, 3);
  const std::vector<Descriptor> one = {descriptors[0]};
  EXPECT_THAT(FindNearest({}, descriptors), IsEmpty());
  EXPECT_THAT(FindNearest(one, {}), ElementsAre(Nearest{}));
  EXPECT_THAT(FindNearest(one, one), ElementsAre(Nearest{0, 0, 257, -1}));
  const std::vector<Descriptor> twice = {descriptors[0], descriptors[0]};
  EXPECT_THAT(FindNearest(one, twice), ElementsAre(Nearest{0, 0, 0, 1}));
}

TEST(FindNearestAmongTest, EqualsTheNaiveSearchForAnyOrderOfCandidates) {
  const auto train = SimilarDescriptors(90, 8);
  std::vector<int> candidates(train.size());
  std::iota(candidates.begin(), candidates.end(), 0);
  std::reverse(candidates.begin(), candidates.begin() + 60);
  for (const auto& query : SimilarDescriptors(20, 9)) {
    EXPECT_EQ(FindNearestAmong(query, train, candidates), NaiveNearest(query, train, candidates));
    candidates.pop_back();
  }
  EXPECT_EQ(FindNearestAmong(train[0], train, {}), Nearest{});
}

TEST(FindNearestInWindowsTest, SearchesOnlyInsideTheWindow) {
  test::Random random(4);
  const auto queries = SimilarDescriptors(60, 5);
  const auto train = SimilarDescriptors(200, 6);
  std::vector<Keypoint> keypoints(train.size());
  for (auto& keypoint : keypoints) {
    keypoint.x = static_cast<float>(random.Uniform(0, 300));
    keypoint.y = static_cast<float>(random.Uniform(0, 200));
    keypoint.octave = random.UniformInt(0, 3);
  }
  std::vector<SearchWindow> windows(queries.size());
  for (auto& window : windows) {
    window = {static_cast<float>(random.Uniform(0, 300)),
              static_cast<float>(random.Uniform(0, 200)), static_cast<float>(random.Uniform(0, 80)),
              random.UniformInt(0, 1), random.UniformInt(1, 3)};
  }
  const KeypointIndex index(keypoints);
  const auto nearest = FindNearestInWindows(queries, windows, train, index);
  for (std::size_t i = 0; i < queries.size(); ++i) {
    const SearchWindow& window = windows[i];
    std::vector<int> inside;
    index.Find(window, inside);
    EXPECT_EQ(nearest[i], NaiveNearest(queries[i], train, inside));
  }
}

TEST(FindNearestInWindowsTest, ThrowsOnSizesThatDiffer) {
  const auto descriptors = RandomDescriptors(2, 7);
  const KeypointIndex index(std::vector<Keypoint>(2));
  const std::vector<SearchWindow> one(1), two(2);
  EXPECT_THAT([&] { FindNearestInWindows(descriptors, one, descriptors, index); },
              ThrowsError("queries and windows", "2 and 1"));
  EXPECT_THAT([&] { FindNearestInWindows(descriptors, two, descriptors, KeypointIndex()); },
              ThrowsError("train", "2 and 0"));
}

TEST(DistanceTestTest, KeepsMatchesUpToTheLimitInQueryOrder) {
  const std::vector<Nearest> nearest = {{4, 50}, {}, {2, 51}, {1, 0}};
  EXPECT_THAT(DistanceTest(nearest, 50), ElementsAre(Match{0, 4, 50}, Match{3, 1, 0}));
  EXPECT_THAT(DistanceTest(nearest, 257),
              ElementsAre(Match{0, 4, 50}, Match{2, 2, 51}, Match{3, 1, 0}));
}

TEST(RatioTestTest, ComparesTheNearestWithTheSecondNearest) {
  const std::vector<Nearest> nearest = {{1, 39, 50, 2}, {1, 40, 50, 2}, {1, 41, 50, 2}};
  const auto kept = RatioTest(nearest, 0.8);
  EXPECT_THAT(kept[0], nearest[0]);
  EXPECT_EQ(kept[1].index, -1);
  EXPECT_EQ(kept[2].index, -1);
}

TEST(RatioTestTest, SingleCandidatesPassAndIdenticalOnesDoNot) {
  const std::vector<Nearest> nearest = {{3, 256, 257, -1}, {3, 0, 0, 4}, {}};
  const auto kept = RatioTest(nearest, 0.5);
  EXPECT_EQ(kept[0], nearest[0]);
  EXPECT_EQ(kept[1].index, -1);
  EXPECT_EQ(kept[2].index, -1);
}

TEST(CrossCheckTest, KeepsMutualNearestNeighborsOnly) {
  const std::vector<Match> matches = {{0, 1, 10}, {1, 1, 20}, {2, 0, 30}};
  const std::vector<Nearest> nearest_of_train = {{5, 9}, {0, 10}};
  EXPECT_THAT(CrossCheck(matches, nearest_of_train), ElementsAre(Match{0, 1, 10}));
  EXPECT_THAT([&] { CrossCheck(matches, std::vector<Nearest>(1)); }, ThrowsError("train", "1"));
}

TEST(KeepUniqueTest, EveryTrainKeypointGoesToItsNearestQuery) {
  const std::vector<Match> matches = {{0, 5, 30}, {1, 2, 8}, {2, 5, 20}, {3, 5, 20}, {4, 3, 9}};
  EXPECT_THAT(KeepUnique(matches), ElementsAre(Match{1, 2, 8}, Match{2, 5, 20}, Match{4, 3, 9}));
  EXPECT_THAT(KeepUnique({}), IsEmpty());
}

/// Matches in which match i connects keypoints i, whose angle changes by changes_deg[i].
struct Rotated {
  explicit Rotated(const std::vector<float>& changes_deg) {
    for (int i = 0; i < static_cast<int>(changes_deg.size()); ++i) {
      const float angle = static_cast<float>(37 * i % 360);
      query.push_back({.angle_deg = angle});
      train.push_back({.angle_deg = std::fmod(angle + changes_deg[i] + 360, 360.0F)});
      matches.push_back({i, i, 1});
    }
  }

  std::vector<int> Kept(int bins = 30) const {
    std::vector<int> kept;
    for (const Match& m : KeepConsistentRotation(matches, query, train, bins)) {
      kept.push_back(m.query);
    }
    return kept;
  }

  std::vector<Keypoint> query, train;
  std::vector<Match> matches;
};

TEST(KeepConsistentRotationTest, SmallChangesOfEitherSignShareABin) {
  EXPECT_THAT(Rotated({-5, 5, 0, -1, 1, 40, 80, 120}).Kept(), ElementsAre(0, 1, 2, 3, 4, 5, 6));
}

TEST(KeepConsistentRotationTest, OnlyTheThreeFullestBinsCount) {
  const Rotated rotated({0, 0, 0, 0, 60, 60, 60, 120, 120, 180, 240, 240});
  EXPECT_THAT(rotated.Kept(), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8));  // tie: 120 before 240
}

TEST(KeepConsistentRotationTest, BinsBelowATenthOfTheFullestDoNotCount) {
  std::vector<float> changes(21, 90);
  changes.insert(changes.end(), {200, 200, 200, 300, 300});
  const auto kept = Rotated(changes).Kept();
  EXPECT_EQ(kept.size(), 24U);  // 21 and 3, but not 2 < 2.1
}

TEST(KeepConsistentRotationTest, OneBinKeepsEverything) {
  EXPECT_THAT(Rotated({0, 100, 200, 300}).Kept(1), ElementsAre(0, 1, 2, 3));
}

TEST(KeepConsistentRotationTest, ThrowsOnInvalidInput) {
  const Rotated rotated({0, 0});
  EXPECT_THAT([&] { KeepConsistentRotation(rotated.matches, {}, rotated.train); },
              ThrowsError("query", "0"));
  EXPECT_THAT([&] { KeepConsistentRotation(rotated.matches, rotated.query, {}); },
              ThrowsError("train", "0"));
  EXPECT_THAT([&] { rotated.Kept(0); }, ThrowsError("bins is 0"));
}

}  // namespace
}  // namespace corvo::orb
