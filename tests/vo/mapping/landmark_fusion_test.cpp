// SPDX-License-Identifier: MIT
#include "vo/mapping/landmark_fusion.h"

#include <gmock/gmock.h>

#include <map>
#include <vector>

#include "tests/vo/mapping/mapping_fixture.h"

namespace corvo {
namespace {

using LandmarkFusionTest = test::MappingTest;

TEST_F(LandmarkFusionTest, FusionMergesDuplicateLandmarks) {
  MakeViews(4, 100);
  // Each of 50 more points becomes two landmarks: one in views 0 and 1, one in views 2 and 3.
  int num_twice = 0;
  for (int point = 100; point < 150; ++point) {
    const std::vector<TrackElement> all = ObservationsOf(point);
    if (all.size() != 4) continue;
    ++num_twice;
    for (const auto& half : {std::vector{all[0], all[1]}, std::vector{all[2], all[3]}}) {
      map_.UpdateAppearance(map_.AddLandmark(scene_.in_world[point], half));
    }
  }
  ASSERT_GT(num_twice, 15);
  FuseLandmarks(3, options_, kMaxDistance, map_);
  std::map<int, int> landmarks_of_point;
  for (LandmarkId id = 0; id < map_.num_landmark_ids(); ++id) {
    const Landmark* landmark = map_.FindLandmark(id);
    if (landmark == nullptr) continue;
    const int point = PointOf(landmark->track[0]);
    ++landmarks_of_point[point];
    for (const TrackElement& o : landmark->track) EXPECT_EQ(PointOf(o), point);
  }
  int num_still_twice = 0;
  for (const auto& [point, count] : landmarks_of_point) num_still_twice += count > 1;
  EXPECT_LE(num_still_twice, num_twice / 10);
}

TEST_F(LandmarkFusionTest, FusionAddsMissingObservations) {
  MakeViews(3, 200);
  int num_removed = 0;
  for (LandmarkId id = 0; id < map_.num_landmark_ids(); id += 2) {
    if (map_.FindLandmark(id)->track.size() < 3) continue;
    map_.RemoveTrackElement(id, 2);
    ++num_removed;
  }
  const int num_fused = FuseLandmarks(2, options_, kMaxDistance, map_).num_fused;
  EXPECT_GT(num_fused, 0.9 * num_removed);
  EXPECT_LE(num_fused, num_removed);
}

}  // namespace
}  // namespace corvo
