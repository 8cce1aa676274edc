// SPDX-License-Identifier: MIT
#include "orb/grid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "tests/support/random.h"

namespace corvo::orb {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

/// Returns distinct random corners in row-major order, with few different scores.
std::vector<Corner> RandomCorners(const cv::Rect& area, int attempts, std::uint64_t seed) {
  test::Random random(seed);
  std::map<std::pair<int, int>, Corner> corners;
  for (int i = 0; i < attempts; ++i) {
    const int x = random.UniformInt(area.x, area.br().x - 1);
    // The density increases towards the bottom.
    const int y = area.br().y - 1 - random.UniformInt(0, random.UniformInt(0, area.height - 1));
    const int score = random.UniformInt(0, 35);
    corners[{y, x}] = {x, y, score};
  }
  std::vector<Corner> ordered;
  for (const auto& [position, corner] : corners) ordered.push_back(corner);
  return ordered;
}

std::vector<int> Strongest(const std::vector<Corner>& corners, int quota) {
  std::vector<int> chosen = {7};
  SelectStrongest(corners, quota, chosen);
  return chosen;
}

TEST(SelectStrongestTest, TakesTheHighestScoresThenTheLowestIndices) {
  const std::vector<Corner> corners = {{0, 0, 9}, {1, 0, 20}, {2, 0, 30}, {3, 0, 20}, {4, 0, 10}};
  EXPECT_THAT(Strongest(corners, 1), ElementsAre(2));
  EXPECT_THAT(Strongest(corners, 2), ElementsAre(1, 2));
  EXPECT_THAT(Strongest(corners, 3), ElementsAre(1, 2, 3));
  EXPECT_THAT(Strongest(corners, 4), ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(Strongest(corners, 9), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(Strongest(corners, 0), IsEmpty());
}

TEST(SelectInGridTest, EveryCellContributesItsStrongestFirst) {
  // There are two cells of 10 x 10; the left one has the highest scores.
  const std::vector<Corner> corners = {{1, 1, 50}, {5, 1, 60}, {15, 1, 8}, {4, 4, 70}, {16, 4, 9}};
  const cv::Rect area(0, 0, 20, 10);
  EXPECT_THAT(SelectInGrid(corners, area, 10, 1), ElementsAre(3));
  EXPECT_THAT(SelectInGrid(corners, area, 10, 2), ElementsAre(3, 4));
  EXPECT_THAT(SelectInGrid(corners, area, 10, 3), ElementsAre(1, 3, 4));
  EXPECT_THAT(SelectInGrid(corners, area, 10, 4), ElementsAre(1, 2, 3, 4));
  EXPECT_THAT(SelectInGrid(corners, area, 10, 5), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(SelectInGrid(corners, area, 10, 0), IsEmpty());
}

TEST(SelectInGridTest, TiesGoToTheLowerIndex) {
  const std::vector<Corner> corners = {{1, 1, 5}, {2, 1, 5}, {11, 1, 5}, {12, 1, 5}};
  const cv::Rect area(0, 0, 20, 10);
  EXPECT_THAT(SelectInGrid(corners, area, 10, 1), ElementsAre(0));
  EXPECT_THAT(SelectInGrid(corners, area, 10, 2), ElementsAre(0, 2));
  EXPECT_THAT(SelectInGrid(corners, area, 10, 3), ElementsAre(0, 1, 2));
}

TEST(SelectInGridTest, SingleCellSelectsTheStrongestOverall) {
  const cv::Rect area(21, 21, 200, 150);
  const auto corners = RandomCorners(area, 500, 2);
  for (const int quota : {1, 17, 200}) {
    EXPECT_EQ(SelectInGrid(corners, area, 1000, quota), Strongest(corners, quota));
  }
}

TEST(SelectInGridTest, PicksExactlyTheQuotaOrAll) {
  const cv::Rect area(21, 21, 313, 157);
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto corners = RandomCorners(area, 700, seed);
    for (const int quota : {1, 2, 50, 333, 600, 5000}) {
      const auto chosen = SelectInGrid(corners, area, 32, quota);
      EXPECT_EQ(chosen.size(), std::min<std::size_t>(quota, corners.size()));
      EXPECT_TRUE(std::is_sorted(chosen.begin(), chosen.end()));
      EXPECT_EQ(std::adjacent_find(chosen.begin(), chosen.end()), chosen.end());
    }
  }
}

/// Implements the definition one corner after another: rounds over the cells while a whole round
/// fits, then the best of the cells' next corners.
std::vector<int> NaiveSelection(const std::vector<Corner>& corners, int columns, int cell_size,
                                int quota) {
  const auto is_better = [&](int a, int b) {
    return std::pair(-corners[a].score, a) < std::pair(-corners[b].score, b);
  };
  std::map<int, std::vector<int>> cells;
  for (int i = 0; i < static_cast<int>(corners.size()); ++i) {
    cells[corners[i].y / cell_size * columns + corners[i].x / cell_size].push_back(i);
  }
  for (auto& [cell, members] : cells) std::sort(members.begin(), members.end(), is_better);
  std::vector<int> chosen;
  for (std::size_t round = 0;; ++round) {
    std::vector<int> next;
    for (const auto& [cell, members] : cells) {
      if (round < members.size()) next.push_back(members[round]);
    }
    std::sort(next.begin(), next.end(), is_better);
    next.resize(std::min(next.size(), quota - chosen.size()));
    if (next.empty()) break;
    chosen.insert(chosen.end(), next.begin(), next.end());
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

TEST(SelectInGridTest, EqualsTheNaiveSelection) {
  const cv::Rect area(0, 0, 160, 96);  // 5 x 3 cells of exactly 32 px
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    const auto corners = RandomCorners(area, 400, seed);
    for (const int quota : {1, 10, 15, 16, 30, 50, 61, 80, 120, 200, 390, 500}) {
      EXPECT_EQ(SelectInGrid(corners, area, 32, quota), NaiveSelection(corners, 5, 32, quota))
          << "seed " << seed << ", quota " << quota;
    }
  }
}

TEST(SelectInGridTest, CellsDifferByAtMostOneUnlessExhausted) {
  const cv::Rect area(0, 0, 320, 160);  // 10 x 5 cells of exactly 32 px
  const auto corners = RandomCorners(area, 1500, 3);
  const auto chosen = SelectInGrid(corners, area, 32, 400);
  const auto cell_of = [&](int i) { return corners[i].y / 32 * 10 + corners[i].x / 32; };
  std::vector<int> available(50, 0), taken(50, 0);
  for (int i = 0; i < static_cast<int>(corners.size()); ++i) ++available[cell_of(i)];
  for (const int i : chosen) ++taken[cell_of(i)];
  const int most = *std::max_element(taken.begin(), taken.end());
  for (int cell = 0; cell < 50; ++cell) {
    EXPECT_GE(taken[cell], std::min(available[cell], most - 1)) << "cell " << cell;
  }
}

}  // namespace
}  // namespace corvo::orb
