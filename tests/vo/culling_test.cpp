#include "vo/culling.h"

#include <gmock/gmock.h>

#include <vector>

#include "tests/vo/mapping_fixture.h"

namespace corvo {
namespace {

using CullingTest = test::MappingTest;

TEST_F(CullingTest, LandmarksThatAreNotFoundAreCulled) {
  MakeViews(3, 200);
  std::vector<LandmarkId> recent = {0, 1};
  for (int i = 0; i < 40; ++i) map_.CountVisible(0);
  CullLandmarks(map_, options_, recent);
  EXPECT_EQ(map_.FindLandmark(0), nullptr);
  EXPECT_NE(map_.FindLandmark(1), nullptr);
}

TEST_F(CullingTest, LandmarksMustBeSeenByAThirdKeyframeInTime) {
  MakeViews(3, 200);
  const LandmarkId twice = map_.AddLandmark({0, 0, 5}, {{0, views_[0].frame.num_keypoints() - 1},
                                                        {1, views_[1].frame.num_keypoints() - 1}});
  std::vector<LandmarkId> recent = {0, twice};
  CullLandmarks(map_, options_, recent);
  EXPECT_THAT(recent, ::testing::ElementsAre(0, twice));
  map_.AddKeyframe(Frame(), 0);
  map_.AddKeyframe(Frame(), 0);
  CullLandmarks(map_, options_, recent);
  EXPECT_EQ(map_.FindLandmark(twice), nullptr);
  EXPECT_THAT(recent, ::testing::ElementsAre(0));
  map_.AddKeyframe(Frame(), 0);
  CullLandmarks(map_, options_, recent);
  EXPECT_TRUE(recent.empty());
  EXPECT_NE(map_.FindLandmark(0), nullptr);
}

TEST_F(CullingTest, RedundantKeyframesAreRetiredButNeverTheFirstOrTheNewest) {
  for (int i = 0; i < 6; ++i) {
    views_.push_back(test::ObserveScene(scene_, camera_, SE3(), 0.2, random_));
  }
  map_ = test::MakeMap(scene_, views_, noise_);
  CullKeyframes(map_, 5, options_);
  EXPECT_FALSE(map_.keyframe(0).retired());
  EXPECT_FALSE(map_.keyframe(5).retired());
  EXPECT_TRUE(map_.keyframe(1).retired());
  int num_kept = 0;
  for (KeyframeId id = 0; id < 6; ++id) num_kept += !map_.keyframe(id).retired();
  EXPECT_GE(num_kept, 3);  // Three others must see what is redundant.
}

TEST_F(CullingTest, NeededKeyframesStay) {
  MakeViews(3, 400);
  CullKeyframes(map_, 2, options_);
  for (KeyframeId id = 0; id < 3; ++id) EXPECT_FALSE(map_.keyframe(id).retired());
}

}  // namespace
}  // namespace corvo
