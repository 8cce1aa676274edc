// SPDX-License-Identifier: MIT
#include "vo/math/percentile.h"

#include <gtest/gtest.h>

namespace corvo {
namespace {

TEST(PercentileTest, FiftiethPercentileIsTheMedian) {
  EXPECT_DOUBLE_EQ(Percentile({3, 1, 2}, 50), 2);
  EXPECT_DOUBLE_EQ(Percentile({4, 1, 2, 3}, 50), 2.5);
}

TEST(PercentileTest, RangesFromTheLeastToTheGreatestValue) {
  EXPECT_DOUBLE_EQ(Percentile({30, 10, 20}, 0), 10);
  EXPECT_DOUBLE_EQ(Percentile({30, 10, 20}, 75), 25);
  EXPECT_DOUBLE_EQ(Percentile({30, 10, 20}, 100), 30);
}

TEST(PercentileTest, SingleValueIsEveryPercentile) {
  for (const double percent : {0.0, 50.0, 99.0, 100.0}) EXPECT_EQ(Percentile({7}, percent), 7);
}

}  // namespace
}  // namespace corvo
