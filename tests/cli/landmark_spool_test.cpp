// SPDX-License-Identifier: MIT
#include "apps/output/landmark_spool.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

namespace corvo {
namespace {

MarginalizedLandmark At(LandmarkId id, int segment, double x) {
  return {id, segment, {x, 0.5, -1.0 / 3}, segment};
}

TEST(LandmarkSpool, ReturnsTheStoredLandmarksInOrder) {
  LandmarkSpool spool;
  spool.ForEach([](const MarginalizedLandmark&) { FAIL(); });
  std::vector<MarginalizedLandmark> given = {At(7, 0, 1), At(3, 2, 1e-9)};
  for (int round = 0; round < 2; ++round) {  // Landmarks can be added after reading.
    std::size_t i = 0;
    for (const MarginalizedLandmark& landmark : given) {
      if (round == 0 || landmark.id == 9) spool.Add(landmark);
    }
    spool.ForEach([&](const MarginalizedLandmark& landmark) {
      ASSERT_LT(i, given.size());
      EXPECT_EQ(landmark.id, given[i].id);
      EXPECT_EQ(landmark.segment, given[i].segment);
      EXPECT_EQ(landmark.in_world, given[i].in_world);
      EXPECT_EQ(landmark.num_joins, given[i].num_joins);
      ++i;
    });
    EXPECT_EQ(i, given.size());
    EXPECT_EQ(spool.size(), static_cast<int>(given.size()));
    EXPECT_EQ(spool.num_bytes(), 40 * given.size());
    given.push_back(At(9, 2, 4));
  }
}

}  // namespace
}  // namespace corvo
