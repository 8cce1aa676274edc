// SPDX-License-Identifier: MIT
#include "orb/workers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <vector>

namespace corvo::orb {
namespace {

TEST(WorkersTest, EveryTaskIsDoneOnce) {
  for (const int threads : {1, 2, 3}) {
    Workers workers(threads);
    for (const int num_tasks : {0, 1, 2, 100}) {
      std::vector<std::atomic<int>> counts(num_tasks);
      workers.ForEach(num_tasks, [&](int i) { ++counts[i]; });
      for (const auto& count : counts) EXPECT_EQ(count, 1);
    }
  }
}

TEST(WorkersTest, SingleThreadWorksInOrder) {
  Workers workers(1);
  std::vector<int> order;
  workers.ForEach(4, [&](int i) { order.push_back(i); });
  EXPECT_THAT(order, testing::ElementsAre(0, 1, 2, 3));
}

}  // namespace
}  // namespace corvo::orb
