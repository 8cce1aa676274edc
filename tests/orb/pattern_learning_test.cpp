// SPDX-License-Identifier: MIT
#include "orb/pattern_learning.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <vector>

#include "tests/orb/pattern_access.h"
#include "tests/support/matchers.h"
#include "tests/support/random.h"

namespace corvo::orb {
namespace {

using test::ThrowsError;

constexpr int kSize = 1000;

/// Returns a training set of independent sums that are equal in both views except in the columns
/// left of `first_steady_x`, where both views are independent.
TrainingSet RandomTraining(int first_steady_x = -kMaxOffset, std::uint64_t seed = 1) {
  test::Random random(seed);
  std::vector<PositionSums> first(kSize);
  std::vector<PositionSums> second(kSize);
  for (int k = 0; k < kSize; ++k) {
    for (int i = 0; i < kNumPositions; ++i) {
      first[k][i] = static_cast<std::uint16_t>(random.UniformInt(0, 25 * 255));
      const bool steady = PositionAt(i).x >= first_steady_x;
      second[k][i] =
          steady ? first[k][i] : static_cast<std::uint16_t>(random.UniformInt(0, 25 * 255));
    }
  }
  TrainingSet training(kSize);
  training.Add(first, second);
  return training;
}

/// Returns the bits of a test over the first views as +1 (set) or -1.
std::vector<int> Signs(const TrainingSet& training, const BinaryTest& test) {
  const std::uint16_t* p = training.first(test::PositionOf(test.p));
  const std::uint16_t* q = training.first(test::PositionOf(test.q));
  std::vector<int> signs(training.size());
  for (int k = 0; k < training.size(); ++k) signs[k] = p[k] < q[k] ? 1 : -1;
  return signs;
}

double Correlation(const std::vector<int>& a, const std::vector<int>& b) {
  double sum_a = 0, sum_b = 0, products = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    sum_a += a[k];
    sum_b += b[k];
    products += a[k] * b[k];
  }
  const auto n = static_cast<double>(a.size());
  return (n * products - sum_a * sum_b) /
         std::sqrt((n * n - sum_a * sum_a) * (n * n - sum_b * sum_b));
}

TEST(TrainingSetTest, StoresSumsByPositionUntilFull) {
  std::vector<PositionSums> first(3);
  std::vector<PositionSums> second(3);
  for (int k = 0; k < 3; ++k) {
    first[k].fill(0);
    second[k].fill(0);
    first[k][728] = static_cast<std::uint16_t>(k + 1);
    second[k][0] = static_cast<std::uint16_t>(k + 11);
  }
  TrainingSet training(5);
  training.Add(first, second);
  EXPECT_EQ(training.size(), 3);
  EXPECT_FALSE(training.is_full());
  training.Add(first, second);
  EXPECT_EQ(training.size(), 5);
  EXPECT_TRUE(training.is_full());
  EXPECT_EQ(std::vector<int>(training.first(728), training.first(728) + 5),
            (std::vector<int>{1, 2, 3, 1, 2}));
  EXPECT_EQ(std::vector<int>(training.second(0), training.second(0) + 5),
            (std::vector<int>{11, 12, 13, 11, 12}));
}

TEST(LearnPatternTest, TestsAreDistinctAndTheirWindowsDoNotOverlap) {
  const Pattern pattern = LearnPattern(RandomTraining(), 1).pattern;
  for (auto test = pattern.begin(); test != pattern.end(); ++test) {
    EXPECT_GE(std::max(std::abs(test->p.x - test->q.x), std::abs(test->p.y - test->q.y)), 5);
    EXPECT_TRUE(std::none_of(pattern.begin(), test,
                             [&](const BinaryTest& other) { return AreEquivalent(*test, other); }));
  }
}

TEST(LearnPatternTest, NoTwoTestsExceedTheReportedCorrelation) {
  const TrainingSet training = RandomTraining();
  const LearningResult result = LearnPattern(training, 1);
  EXPECT_EQ(result.max_correlation, 0.2) << "tests that share no window are independent";
  EXPECT_EQ(result.flip_rate, 0);
  std::vector<std::vector<int>> signs;
  for (const BinaryTest& test : result.pattern) signs.push_back(Signs(training, test));
  for (int i = 0; i < kNumTests; ++i) {
    for (int j = 0; j < i; ++j) {
      ASSERT_LE(std::abs(Correlation(signs[i], signs[j])), result.max_correlation + 1e-12);
    }
  }
}

TEST(LearnPatternTest, CorrelationThresholdRisesIfTestsCorrelate) {
  const TrainingSet independent = RandomTraining();
  std::vector<PositionSums> alike(kSize);
  for (int k = 0; k < kSize; ++k) {  // A slope in a random direction, and a little noise.
    for (int i = 0; i < kNumPositions; ++i) {
      const int noise = independent.first(i)[k] / 200;
      const int slope_x = independent.first(0)[k] % 101 - 50;
      const int slope_y = independent.first(1)[k] % 101 - 50;
      const Offset at = PositionAt(i);
      alike[k][i] = static_cast<std::uint16_t>(3000 + slope_x * at.x + slope_y * at.y + noise);
    }
  }
  TrainingSet training(kSize);
  training.Add(alike, alike);
  std::vector<double> thresholds;
  const LearningResult result = LearnPattern(training, 1, [&](const SelectionProgress& progress) {
    if (thresholds.empty() || progress.max_correlation != thresholds.back()) {
      thresholds.push_back(progress.max_correlation);
    }
    EXPECT_LE(progress.num_chosen, kNumTests);
  });
  EXPECT_GT(result.max_correlation, 0.2);
  EXPECT_EQ(thresholds.front(), 0.2);
  EXPECT_EQ(thresholds.back(), result.max_correlation);
  EXPECT_TRUE(std::is_sorted(thresholds.begin(), thresholds.end()));
}

TEST(LearnPatternTest, PrefersTestsWhoseBitIsStable) {
  const int first_steady_x = -kMaxOffset + 3;
  const LearningResult result = LearnPattern(RandomTraining(first_steady_x), 1);
  EXPECT_EQ(result.flip_rate, 0);
  for (const auto& [p, q] : result.pattern) EXPECT_GE(std::min(p.x, q.x), first_steady_x);
}

TEST(LearnPatternTest, TestsWhoseBitNeverVariesAreNotChosen) {
  const TrainingSet random = RandomTraining();
  constexpr int kDarkest = 0, kBrightest = 600;
  std::vector<PositionSums> sums(kSize);
  for (int k = 0; k < kSize; ++k) {
    for (int i = 0; i < kNumPositions; ++i) sums[k][i] = random.first(i)[k] % 1000 + 1;
    sums[k][kDarkest] = 0;
    sums[k][kBrightest] = 2000;
  }
  TrainingSet training(kSize);
  training.Add(sums, sums);
  for (const auto& [p, q] : LearnPattern(training, 1).pattern) {
    for (const int position : {test::PositionOf(p), test::PositionOf(q)}) {
      EXPECT_NE(position, kDarkest);
      EXPECT_NE(position, kBrightest);
    }
  }
}

TEST(LearnPatternTest, PatternDoesNotDependOnTheNumberOfThreads) {
  const TrainingSet training = RandomTraining(-5);
  const Pattern pattern = LearnPattern(training, 1).pattern;
  for (const int threads : {2, 5}) EXPECT_EQ(LearnPattern(training, threads).pattern, pattern);
  EXPECT_NE(LearnPattern(RandomTraining(-5, 2), 1).pattern, pattern);
}

TEST(LearnPatternTest, TooFewKeypointsOrTestsAreErrors) {
  EXPECT_THAT([] { LearnPattern(TrainingSet(kSize), 1); },
              ThrowsError("0 keypoints", "at least 1000"));
  TrainingSet flat(kSize);
  PositionSums sums;
  sums.fill(7);
  const std::vector<PositionSums> same(kSize, sums);
  flat.Add(same, same);
  EXPECT_THAT([&] { LearnPattern(flat, 1); }, ThrowsError("only 0 tests vary", "256 are needed"));
}

}  // namespace
}  // namespace corvo::orb
