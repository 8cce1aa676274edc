// SPDX-License-Identifier: MIT
#include "orb/apportion.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "tests/support/random.h"

namespace corvo::orb {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<int> Shares(int total, std::vector<std::int64_t> weights, std::vector<int> capacities) {
  std::vector<int> shares(weights.size());
  Apportion(total, weights, capacities, shares);
  return shares;
}

TEST(ApportionTest, SharesAreProportional) {
  EXPECT_THAT(Shares(100, {5, 3, 2}, {1000, 1000, 1000}), ElementsAre(50, 30, 20));
}

TEST(ApportionTest, LargestRemaindersGetTheLeftoverUnits) {
  EXPECT_THAT(Shares(10, {34, 33, 33}, {99, 99, 99}), ElementsAre(4, 3, 3));
  EXPECT_THAT(Shares(10, {24, 57, 19}, {99, 99, 99}), ElementsAre(2, 6, 2));  // 2.4, 5.7, 1.9
}

TEST(ApportionTest, EqualRemaindersGoToTheLowerIndex) {
  EXPECT_THAT(Shares(5, {1, 1, 1}, {9, 9, 9}), ElementsAre(2, 2, 1));
}

TEST(ApportionTest, ExcessOverACapacityGoesToTheOthersInProportion) {
  EXPECT_THAT(Shares(100, {5, 3, 2}, {0, 1000, 1000}), ElementsAre(0, 60, 40));
  EXPECT_THAT(Shares(100, {5, 3, 2}, {10, 40, 1000}), ElementsAre(10, 40, 50));
}

TEST(ApportionTest, TotalIsBoundedByTheCapacities) {
  EXPECT_THAT(Shares(100, {5, 3, 2}, {1, 2, 3}), ElementsAre(1, 2, 3));
  EXPECT_THAT(Shares(0, {5, 3}, {1, 2}), ElementsAre(0, 0));
  EXPECT_THAT(Shares(7, {0, 3}, {0, 9}), ElementsAre(0, 7));
  EXPECT_THAT(Shares(7, {}, {}), IsEmpty());
}

TEST(ApportionTest, SumIsExactAndNoCapacityIsExceeded) {
  test::Random random(1);
  for (int run = 0; run < 2000; ++run) {
    const int size = random.UniformInt(1, 9);
    std::vector<std::int64_t> weights;
    std::vector<int> capacities;
    for (int i = 0; i < size; ++i) {
      weights.push_back(random.UniformInt(1, 100000));
      capacities.push_back(random.UniformInt(0, 300));
    }
    const int total = random.UniformInt(0, 1500);
    const auto shares = Shares(total, weights, capacities);
    const int available = std::accumulate(capacities.begin(), capacities.end(), 0);
    EXPECT_EQ(std::accumulate(shares.begin(), shares.end(), 0), std::min(total, available));
    for (int i = 0; i < size; ++i) {
      EXPECT_GE(shares[i], 0);
      EXPECT_LE(shares[i], capacities[i]);
    }
  }
}

}  // namespace
}  // namespace corvo::orb
