// SPDX-License-Identifier: MIT
#include "vo/tracking/pending_frames.h"

#include <gmock/gmock.h>

#include <vector>

#include "tests/support/matchers.h"
#include "tests/support/point_scene.h"

namespace corvo {
namespace {

using testing::ElementsAre;

/// A map of three views 0.3 apart along x, and frames 0.05 apart that wait around the last one.
class PendingFramesTest : public ::testing::Test {
 protected:
  PendingFramesTest() {
    std::vector<test::SceneView> views;
    for (int i = 0; i < 3; ++i) views.push_back(View(0.3 * i));
    map_ = test::MakeMap(scene_, views);
    for (int i = 0; i < 7; ++i) {
      Frame frame = i == kLocated ? map_.keyframe(2).frame : View(PositionOf(i)).frame;
      frame.index = i;
      frame.time_ns = i * 100'000'000;
      if (i != kLocated) frame.world_from_camera = SE3();
      history_.Add(frame.time_ns);
      frames_.push_back(frame);
    }
    history_.AddKeyframe(kLocated, 2, map_);
  }

  static double PositionOf(int frame) { return 0.6 + 0.05 * (frame - kLocated); }

  test::SceneView View(double x) {
    return test::ObserveScene(scene_, test::PinholeCamera(), SE3(SO3(), {x, 0, 0}), 0.3, random_);
  }

  /// Returns the positions of the frames that are located, in this order.
  std::vector<int> Locate(int step) {
    const Tracker tracker{OdometryOptions()};
    const MotionModel motion;
    const PendingFrameLocator locator(tracker, motion, map_, history_);
    std::vector<int> positions;
    for (const LocatedFrame& located : locator.Locate(frames_, kLocated, step)) {
      const int i = located.position;
      positions.push_back(i);
      EXPECT_GT(located.counts.num_inliers, 100) << i;
      EXPECT_THAT(frames_[i].world_from_camera,
                  test::IsPoseNear(SE3(SO3(), {PositionOf(i), 0, 0}), 0.1, 0.02))
          << i;
    }
    return positions;
  }

  static constexpr int kLocated = 3;
  test::Random random_{1};
  test::PointScene scene_ = test::MakeBoxScene(600, 3, 12, random_);
  Map map_{test::MakeModel()};
  FrameHistory history_;
  std::vector<Frame> frames_;
};

TEST_F(PendingFramesTest, AreLocatedUpToTheFirstAndTheLast) {
  EXPECT_THAT(Locate(1), ElementsAre(4, 5, 6));
  EXPECT_THAT(Locate(-1), ElementsAre(2, 1, 0));
}

TEST_F(PendingFramesTest, AreLocatedUpToTheNextThatHasAPose) {
  history_.SetPose(5, 0, SE3(), map_);
  history_.SetPose(0, 0, SE3(), map_);
  EXPECT_THAT(Locate(1), ElementsAre(4));
  EXPECT_THAT(Locate(-1), ElementsAre(2, 1));
}

TEST_F(PendingFramesTest, AFrameThatCannotBeLocatedIsLeftOut) {
  SelectKeypoints({}, frames_[4]);
  EXPECT_THAT(Locate(1), ElementsAre(5, 6));
}

}  // namespace
}  // namespace corvo
