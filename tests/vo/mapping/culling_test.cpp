// SPDX-License-Identifier: MIT
#include "vo/mapping/culling.h"

#include <gmock/gmock.h>

#include <vector>

#include "tests/vo/mapping/mapping_fixture.h"

namespace corvo {
namespace {

using CullingTest = test::MappingTest;

TEST_F(CullingTest, LandmarksThatAreRarelyFoundAreCulled) {
  MakeViews(3, 200);
  std::vector<LandmarkId> recent = {0, 1};
  for (int i = 0; i < 40; ++i) map_.CountSeen({0}, Frame());
  CullLandmarks(CullingOptions(), recent, map_);
  EXPECT_EQ(map_.FindLandmark(0), nullptr);
  EXPECT_NE(map_.FindLandmark(1), nullptr);
}

TEST_F(CullingTest, LandmarksWithoutATimelyThirdObservationAreCulled) {
  MakeViews(3, 200);
  const LandmarkId twice = map_.AddLandmark({0, 0, 5}, {{0, views_[0].frame.num_keypoints() - 1},
                                                        {1, views_[1].frame.num_keypoints() - 1}});
  std::vector<LandmarkId> recent = {0, twice};
  CullLandmarks(CullingOptions(), recent, map_);
  EXPECT_THAT(recent, ::testing::ElementsAre(0, twice));
  map_.AddKeyframe(Frame(), 0);
  map_.AddKeyframe(Frame(), 0);
  CullLandmarks(CullingOptions(), recent, map_);
  EXPECT_EQ(map_.FindLandmark(twice), nullptr);
  EXPECT_THAT(recent, ::testing::ElementsAre(0));
  map_.AddKeyframe(Frame(), 0);
  CullLandmarks(CullingOptions(), recent, map_);
  EXPECT_TRUE(recent.empty());
  EXPECT_NE(map_.FindLandmark(0), nullptr);
}

TEST_F(CullingTest, RedundantKeyframesAreCulledButNeverTheFirstOrTheNewest) {
  for (int i = 0; i < 6; ++i) {
    views_.push_back(test::ObserveScene(scene_, camera_, SE3(), 0.2, random_));
  }
  map_ = test::MakeMap(scene_, views_);
  CullKeyframes(5, CullingOptions(), map_);
  EXPECT_TRUE(map_.IsActive(0));
  EXPECT_TRUE(map_.IsActive(5));
  EXPECT_FALSE(map_.IsActive(1));
  EXPECT_GE(map_.ActiveKeyframes().size(), 3u);  // Redundancy needs three other observers.
}

TEST_F(CullingTest, KeyframesNextToThoseOfAnotherSegmentStayActive) {
  for (int i = 0; i < 8; ++i) {
    views_.push_back(test::ObserveScene(scene_, camera_, SE3(), 0.2, random_));
  }
  map_ = Map(test::MakeModel());
  for (int i = 0; i < 8; ++i) map_.AddKeyframe(views_[i].frame, i == 4 ? 1 : 0);
  std::vector<std::vector<TrackElement>> tracks(scene_.in_world.size());
  for (int i = 0; i < 8; ++i) {
    if (i == 4) continue;
    for (std::size_t k = 0; k < views_[i].points.size(); ++k) {
      tracks[views_[i].points[k]].push_back({i, static_cast<int>(k)});
    }
  }
  for (std::size_t point = 0; point < tracks.size(); ++point) {
    if (tracks[point].size() > 1) map_.AddLandmark(scene_.in_world[point], tracks[point]);
  }
  CullKeyframes(7, CullingOptions(), map_);
  EXPECT_FALSE(map_.IsActive(1));
  EXPECT_TRUE(map_.IsActive(3));
  EXPECT_TRUE(map_.IsActive(5));
}

TEST_F(CullingTest, NeededKeyframesStayActive) {
  MakeViews(3, 400);
  CullKeyframes(2, CullingOptions(), map_);
  EXPECT_EQ(map_.ActiveKeyframes().size(), 3u);
}

TEST_F(CullingTest, OldKeyframesAreMarginalizedUnlessTheNewestObservesTheirLandmarks) {
  step_ = 0;
  MakeViews(5, 0);
  const LandmarkId old = map_.AddLandmark({0, 0, 5}, {{0, 0}, {2, 0}});
  const LandmarkId shared = map_.AddLandmark({0, 0, 5}, {{1, 1}, {4, 1}});
  const LandmarkId recent = map_.AddLandmark({0, 0, 5}, {{3, 2}, {4, 2}});
  EXPECT_TRUE(MarginalizeKeyframes(5, {}, map_).empty());
  EXPECT_EQ(map_.ActiveKeyframes().size(), 5u);
  const std::vector<MarginalizedLandmark> finished = MarginalizeKeyframes(2, {}, map_);
  EXPECT_THAT(map_.ActiveKeyframes(), ::testing::ElementsAre(1, 3, 4));
  ASSERT_EQ(finished.size(), 1u);
  EXPECT_EQ(finished[0].id, old);
  EXPECT_NE(map_.FindLandmark(shared), nullptr);
  EXPECT_NE(map_.FindLandmark(recent), nullptr);
  EXPECT_TRUE(MarginalizeKeyframes(2, {}, map_).empty());
}

}  // namespace
}  // namespace corvo
