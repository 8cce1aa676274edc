// SPDX-License-Identifier: MIT
#include "vo/mapping/landmark_creation.h"

#include <gmock/gmock.h>

#include "tests/vo/mapping/mapping_fixture.h"

namespace corvo {
namespace {

using LandmarkCreationTest = test::MappingTest;

TEST_F(LandmarkCreationTest, NewLandmarksAreNearTheTruePoints) {
  MakeViews(3, 100);
  const LandmarkId first_new = map_.num_landmark_ids();
  const int num_created = CreateLandmarks(2, options_, kMaxDistance, map_);
  EXPECT_GT(num_created, 100);
  EXPECT_EQ(num_created, map_.num_landmark_ids() - first_new);
  for (LandmarkId id = first_new; id < map_.num_landmark_ids(); ++id) {
    const Landmark& landmark = *map_.FindLandmark(id);
    const int point = PointOf(landmark.track[0]);
    EXPECT_EQ(PointOf(landmark.track[1]), point);
    EXPECT_LT((landmark.in_world - scene_.in_world[point]).norm(),
              0.1 * scene_.in_world[point].norm());
  }
}

TEST_F(LandmarkCreationTest, NothingIsTriangulatedOverATinyBaseline) {
  step_ = 0.01;
  options_.min_parallax_deg = 0;
  MakeViews(3, 100);
  EXPECT_EQ(CreateLandmarks(2, options_, kMaxDistance, map_), 0);
}

TEST_F(LandmarkCreationTest, FarPointsWithoutParallaxAreLeftOut) {
  scene_ = test::MakeBoxScene(400, 200, 300, random_);
  MakeViews(3, 100);
  EXPECT_EQ(CreateLandmarks(2, options_, kMaxDistance, map_), 0);
}

TEST_F(LandmarkCreationTest, AllRaysAreUpdatedToTheCurrentCamera) {
  MakeViews(3, 100);
  CameraParameters parameters = camera_.parameters();
  parameters.k1 = 0.02;
  const Camera camera(parameters);
  map_.SetCamera(camera);
  Map updated = map_;
  for (KeyframeId id = 0; id < 3; ++id) updated.UpdateRays(id);
  map_.UpdateRays(2);
  const LandmarkId first_new = map_.num_landmark_ids();
  ASSERT_GT(CreateLandmarks(2, options_, kMaxDistance, updated), 100);
  CreateLandmarks(2, options_, kMaxDistance, map_);
  ASSERT_EQ(map_.num_landmark_ids(), updated.num_landmark_ids());
  for (LandmarkId id = first_new; id < map_.num_landmark_ids(); ++id) {
    EXPECT_EQ(map_.FindLandmark(id)->in_world, updated.FindLandmark(id)->in_world);
  }
}

}  // namespace
}  // namespace corvo
