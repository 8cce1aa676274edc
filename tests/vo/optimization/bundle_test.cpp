// SPDX-License-Identifier: MIT
#include "vo/optimization/bundle.h"

#include <gmock/gmock.h>

#include <vector>

#include "tests/support/matchers.h"
#include "tests/support/point_scene.h"
#include "vo/lie/sim3.h"

namespace corvo {
namespace {

/// A map of four views along x, and a bundle of the first three views with every second landmark.
class WriteBackTest : public ::testing::Test {
 protected:
  WriteBackTest() {
    std::vector<test::SceneView> views;
    for (int i = 0; i < 4; ++i) {
      const SE3 pose(SO3(), Eigen::Vector3d(0.3 * i, 0, 0));
      views.push_back(test::ObserveScene(scene_, camera_, pose, 0, random_));
    }
    map_ = test::MakeMap(scene_, views);
    AdjustmentWindow window{{0, 1, 2}, {}, {}};
    for (const LandmarkId id : map_.FindObserved({0, 1, 2})) {
      if (id % 2 == 0) window.landmarks.push_back(id);
    }
    bundle_ = CopyBundle(map_, window);
  }

  /// Moves the whole bundle, which an adjustment never does.
  void Move(const Sim3& move) {
    const Sim3 local_move =
        Sim3(bundle_.world_from_local.Inverse()) * move * Sim3(bundle_.world_from_local);
    for (Bundle::View& view : bundle_.views) {
      view.local_from_camera = TransformPose(local_move, view.Pose()).data();
    }
    for (Bundle::Point& point : bundle_.points) point.in_local = local_move * point.in_local;
  }

  test::Random random_{1};
  Camera camera_ = test::PinholeCamera();
  test::PointScene scene_ = test::MakeBoxScene(200, 3, 10, random_);
  Map map_{test::MakeModel()};
  Bundle bundle_;
};

TEST_F(WriteBackTest, KeyframesAndLandmarksOutsideTheBundleMoveWithIt) {
  const Map before = map_;
  const Sim3 move(1.1, SO3::Exp({0.02, -0.1, 0.03}), Eigen::Vector3d(0.2, -0.3, 0.1));
  Move(move);
  WriteBack(bundle_, map_);
  for (KeyframeId id = 0; id < 4; ++id) {
    EXPECT_THAT(map_.WorldFromKeyframe(id),
                test::IsPoseNear(TransformPose(move, before.WorldFromKeyframe(id)), 1e-9, 1e-9))
        << id;
  }
  for (const LandmarkId id : map_.FindObserved({0, 1, 2, 3})) {
    EXPECT_THAT(map_.FindLandmark(id)->in_world,
                test::IsMatrixNear(move * before.FindLandmark(id)->in_world, 1e-9))
        << id;
  }
}

TEST_F(WriteBackTest, KeyframesStayIfAllViewsAreFixed) {
  for (Bundle::View& view : bundle_.views) view.is_fixed = true;
  const Map before = map_;
  Move(Sim3(1, SO3(), {1, 0, 0}));
  WriteBack(bundle_, map_);
  for (KeyframeId id = 0; id < 4; ++id) {
    EXPECT_EQ(map_.WorldFromKeyframe(id), before.WorldFromKeyframe(id));
  }
}

TEST_F(WriteBackTest, RemovedKeyframesAndLandmarksAreSkipped) {
  const LandmarkId removed = bundle_.points[0].landmark;
  const LandmarkId changed = bundle_.points[1].landmark;
  const TrackElement element = map_.FindLandmark(changed)->track.front();
  map_.RemoveLandmark(removed);
  map_.RemoveTrackElement(changed, element.keyframe);
  map_.CullKeyframe(1, 0);
  for (Bundle::Observation& observation : bundle_.observations)
    observation.is_inlier = observation.point > 1;
  WriteBack(bundle_, map_);
  EXPECT_EQ(map_.FindLandmark(removed), nullptr);
  EXPECT_FALSE(map_.IsActive(1));
}

}  // namespace
}  // namespace corvo
