// SPDX-License-Identifier: MIT
#include "vo/tracking/relocalizer.h"

#include <gmock/gmock.h>

#include <vector>

#include "tests/support/matchers.h"
#include "tests/support/point_scene.h"

namespace corvo {
namespace {

/// A map of six views of a scene, the later ones turned far from the first.
class RelocalizerTest : public ::testing::Test {
 protected:
  RelocalizerTest() {
    std::vector<test::SceneView> views;
    for (int i = 0; i < 6; ++i) views.push_back(View(PoseAt(i)));
    map_ = test::MakeMap(scene_, views);
  }

  static SE3 PoseAt(double i) {
    return SE3(SO3::Exp({0, 0.15 * i, 0}), Eigen::Vector3d(0.3 * i, 0, 0));
  }

  test::SceneView View(const SE3& pose) {
    return test::ObserveScene(scene_, camera_, pose, 0.3, random_);
  }

  TrackingResult Locate(Frame& frame, const RelocalizerOptions& options = {}) {
    OdometryOptions all;
    all.relocalizer = options;
    return Relocalizer(all).Relocalize(0, map_, frame);
  }

  test::Random random_{1};
  Camera camera_ = test::PinholeCamera();
  test::PointScene scene_ = test::MakeBoxScene(900, 3, 12, random_);
  Map map_{test::MakeModel()};
};

TEST_F(RelocalizerTest, LocatesAFrameAnywhereInTheMap) {
  for (const double i : {0.5, 2.2, 4.5}) {
    test::SceneView view = View(PoseAt(i));
    view.frame.world_from_camera = SE3();
    EXPECT_EQ(Locate(view.frame).reason, Reason::kNone) << i;
    EXPECT_THAT(view.frame.world_from_camera, test::IsPoseNear(PoseAt(i), 0.2, 0.03)) << i;
  }
}

TEST_F(RelocalizerTest, SearchesOnlyTheNewestKeyframes) {
  RelocalizerOptions options;
  options.max_keyframes = 1;
  test::SceneView view = View(PoseAt(-2));  // Shares nothing with the newest.
  EXPECT_NE(Locate(view.frame, options).reason, Reason::kNone);
}

TEST_F(RelocalizerTest, SearchesOtherSegmentsLast) {
  const Relocalizer relocalizer{OdometryOptions()};
  test::SceneView view = View(PoseAt(1));
  EXPECT_FALSE(relocalizer.RelocalizeElsewhere(0, map_, view.frame).is_tracked());
  EXPECT_TRUE(relocalizer.RelocalizeElsewhere(1, map_, view.frame).is_tracked());
  EXPECT_EQ(SegmentOf(map_, view.frame), 0);
  view = View(PoseAt(1));
  EXPECT_TRUE(relocalizer.Relocalize(1, map_, view.frame).is_tracked());
  EXPECT_EQ(SegmentOf(map_, view.frame), 0);
}

TEST_F(RelocalizerTest, RequiresEnoughInliers) {
  test::SceneView view = View(PoseAt(1));
  RelocalizerOptions options;
  options.min_inliers = 10000;
  EXPECT_EQ(Locate(view.frame, options).reason, Reason::kTooFewInliers);
}

TEST_F(RelocalizerTest, RejectsAnUnknownPlace) {
  const test::PointScene elsewhere = test::MakeBoxScene(900, 3, 12, random_);
  test::SceneView view = test::ObserveScene(elsewhere, camera_, PoseAt(1), 0.3, random_);
  EXPECT_NE(Locate(view.frame).reason, Reason::kNone);
}

}  // namespace
}  // namespace corvo
