// SPDX-License-Identifier: MIT
#include "apps/output/final_map.h"

#include <gmock/gmock.h>

#include <fstream>

#include "apps/output/map_ply.h"
#include "apps/output/npy_file.h"
#include "apps/output/observation_table.h"
#include "orb/error.h"
#include "tests/support/data.h"
#include "tests/support/point_scene.h"

namespace corvo {
namespace {

TEST(MapPly, ReadsBackWhatWasWritten) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "map.ply";
  std::vector<MapPoint> points(2);
  points[0] = {7, 1, {1.0 / 3, -2e-9, 4e6}, {1, 2, 255}, 12};
  points[1] = {8, 0, {0, 0, 1}, {0, 0, 0}, 0};
  std::ofstream(file, std::ios::binary) << ToPly(points);
  const std::vector<MapPoint> read = ReadMapPly(file);
  ASSERT_EQ(read.size(), points.size());
  for (std::size_t i = 0; i < read.size(); ++i) {
    EXPECT_EQ(read[i].id, points[i].id);
    EXPECT_EQ(read[i].segment, points[i].segment);
    EXPECT_EQ(read[i].in_world, points[i].in_world);
    EXPECT_EQ(read[i].rgb, points[i].rgb);
    EXPECT_EQ(read[i].num_observations, points[i].num_observations);
  }
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 1);
  EXPECT_THROW(ReadMapPly(file), Error);
  EXPECT_THROW(ReadMapPly(folder.path() / "missing.ply"), Error);
}

TEST(ObservationTable, ReadsBackWhatWasWritten) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "observations.npy";
  ObservationWriter writer(file);
  for (int i = 0; i < 3; ++i) writer.Add({i, 100000 + i, 0.1F * i, 1e3F + i, 0.5F});
  writer.Finish();
  EXPECT_EQ(std::filesystem::file_size(file), kNpyHeaderSize + 3 * 18u);
  const std::vector<ObservationRow> rows = ReadObservations(file);
  ASSERT_EQ(rows.size(), 3u);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(rows[i].frame, i);
    EXPECT_EQ(rows[i].landmark, 100000 + i);
    EXPECT_EQ(rows[i].x, 0.1F * i);
    EXPECT_EQ(rows[i].y, 1e3F + i);
    EXPECT_EQ(rows[i].sigma_px, 0.5F);
  }
  std::filesystem::resize_file(file, std::filesystem::file_size(file) - 1);
  EXPECT_THROW(ReadObservations(file), Error);
}

TEST(FinalMap, PointsOfAJoinedSegmentMoveWithIt) {
  LandmarkSpool spool;
  Map map(test::MakeModel());
  spool.Add({0, 1, {1, 2, 3}, 0});
  map.JoinSegments({0, 1, Sim3(2, SO3(), {10, 0, 0})});
  spool.Add({1, 1, {1, 2, 3}, 1});  // Another segment, which has got the index anew.
  const std::vector<MapPoint> points = CollectPoints(spool, map);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].segment, 0);
  EXPECT_EQ(points[0].in_world, Eigen::Vector3d(12, 4, 6));
  EXPECT_EQ(points[1].segment, 1);
  EXPECT_EQ(points[1].in_world, Eigen::Vector3d(1, 2, 3));
}

TEST(FinalMap, LandmarksOfADiscardedMapAreLeftOut) {
  LandmarkSpool spool;
  spool.Add({4, 0, {1, 2, 3}, 0});
  spool.Add({5, 0, {4, 5, 6}, 0});
  const std::vector<MapPoint> points = CollectPoints(spool, Map(test::MakeModel(), 5));
  ASSERT_EQ(points.size(), 1u);
  EXPECT_EQ(points[0].id, 5);
}

}  // namespace
}  // namespace corvo
