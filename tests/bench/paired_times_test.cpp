// SPDX-License-Identifier: MIT
#include "bench/paired_times.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace corvo::bench {
namespace {

using testing::ElementsAre;

LeastTimes Times(const std::vector<double>& ms) {
  LeastTimes times(static_cast<int>(ms.size()));
  for (std::size_t i = 0; i < ms.size(); ++i) times.Add(static_cast<int>(i), ms[i]);
  return times;
}

TEST(LeastTimesTest, KeepsTheLeastOfEachItem) {
  LeastTimes times(2);
  times.Add(0, 3);
  times.Add(1, 5);
  times.Add(0, 2);
  times.Add(1, 6);
  EXPECT_THAT(times.ms(), ElementsAre(2, 5));
}

TEST(SummarizeTest, RatioIsTheMedianOfTheItemRatiosNotTheRatioOfMedians) {
  const PairedSummary summary = Summarize(Times({1, 2, 10}), Times({4, 20, 30}));
  EXPECT_DOUBLE_EQ(summary.ratio, 4);  // The median of 4, 10 and 3.
  EXPECT_DOUBLE_EQ(summary.ms, 2);
  EXPECT_DOUBLE_EQ(summary.baseline_ms, 20);
}

TEST(SummarizeTest, PercentilesAreOverItems) {
  const PairedSummary summary = Summarize(Times({1, 2}), Times({4, 6}));
  EXPECT_DOUBLE_EQ(summary.p99_ms, 1.99);
  EXPECT_DOUBLE_EQ(summary.baseline_p99_ms, 5.98);
  EXPECT_DOUBLE_EQ(summary.ratio_p10, 3.1);
  EXPECT_DOUBLE_EQ(summary.ratio_p90, 3.9);
}

}  // namespace
}  // namespace corvo::bench
