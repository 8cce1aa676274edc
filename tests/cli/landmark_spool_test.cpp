// SPDX-License-Identifier: MIT
#include "apps/output/landmark_spool.h"

#include <gmock/gmock.h>

#include <string>
#include <vector>

#include "apps/output/map_ply.h"
#include "tests/support/point_scene.h"

namespace corvo {
namespace {

MarginalizedLandmark At(LandmarkId id, int segment, double x) {
  return {id, segment, {x, 0.5, -1.0 / 3}};
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
      ++i;
    });
    EXPECT_EQ(i, given.size());
    EXPECT_EQ(spool.size(), static_cast<int>(given.size()));
    EXPECT_EQ(spool.num_bytes(), 32 * given.size());
    given.push_back(At(9, 2, 4));
  }
}

TEST(LandmarkSpool, StoredLandmarksAreWrittenToThePly) {
  LandmarkSpool spool;
  spool.Add(At(0, 1, 2));
  Map map(test::MakeModel());
  map.AddKeyframe(Frame(), 0);
  const std::string ply = MapPly(spool, map, 10);
  EXPECT_THAT(ply, testing::HasSubstr("element vertex 2\n"));
  EXPECT_THAT(ply, testing::HasSubstr("end_header\n20 5 -3.33333333 160 160 160 1\n0 0 0"));
}

}  // namespace
}  // namespace corvo
